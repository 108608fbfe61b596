import subprocess
import sys
from xml.etree import ElementTree

import matplotlib as mpl
import pytest

from tests.figures import nested
from tests.figures.samples import drive, room, transport
from understudy.errors import UnderstudyError
from understudy.figures import draw_arena, draw_network, save

ANOTHER_PROCESS = """
from tests.figures.samples import transport
from understudy.figures import draw_network, save
import sys
save(draw_network(transport(), title="fetch"), sys.argv[1])
"""


def test_a_picture_is_written_twice_over(tmp_path):
    files = save(draw_network(transport()), tmp_path / "new" / "task.v2")
    assert [file.name for file in files] == ["task.v2.png", "task.v2.svg"]
    assert files[0].read_bytes().startswith(b"\x89PNG\r\n\x1a\n")
    assert b"</svg>" in files[1].read_bytes()


@pytest.mark.parametrize("kind", ["png", "svg"])
def test_nothing_is_overwritten(tmp_path, kind):
    there = tmp_path / f"task.{kind}"
    there.write_text("precious")
    with pytest.raises(UnderstudyError, match=rf"task\.{kind}: this picture exists already.*name another"):
        save(draw_network(transport()), tmp_path / "task")
    assert there.read_text() == "precious"
    assert [file.name for file in tmp_path.iterdir()] == [there.name]


def test_a_place_that_is_no_folder_is_refused(tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(UnderstudyError, match="no folder to write to"):
        save(draw_network(transport()), tmp_path / "file" / "task")


def test_the_same_picture_has_the_same_bytes(tmp_path):
    for name in ("one", "other"):
        save(draw_arena(room(), [drive()]), tmp_path / name)
    for kind in ("png", "svg"):
        assert (tmp_path / f"one.{kind}").read_bytes() == (tmp_path / f"other.{kind}").read_bytes()


def test_another_process_writes_the_same_bytes(tmp_path):
    save(draw_network(transport(), title="fetch"), tmp_path / "here")
    subprocess.run([sys.executable, "-c", ANOTHER_PROCESS, str(tmp_path / "there")], check=True)
    for kind in ("png", "svg"):
        assert (tmp_path / f"here.{kind}").read_bytes() == (tmp_path / f"there.{kind}").read_bytes()


def test_no_date_and_no_version_in_the_files(tmp_path):
    png, svg = save(draw_network(transport()), tmp_path / "task")
    assert b"tEXt" not in png.read_bytes()
    assert b"dc:date" not in svg.read_bytes()
    assert b"dc:creator" not in svg.read_bytes()


def test_an_svg_says_what_it_shows(tmp_path):
    _, svg = save(draw_network(nested.hierarchical(), title="fetch & visit"), tmp_path / "task")
    root = ElementTree.parse(svg).getroot()
    assert root.tag == "{http://www.w3.org/2000/svg}svg"
    assert root.findtext("{http://www.w3.org/2000/svg}title") == "fetch & visit"
    _, svg = save(draw_arena(room(), [drive()]), tmp_path / "room")
    assert ElementTree.parse(svg).getroot().findtext("{http://www.w3.org/2000/svg}title") == "fetch through a gate"


def test_global_settings_are_left_alone(tmp_path):
    before = dict(mpl.rcParams)
    save(draw_network(transport()), tmp_path / "task")
    assert dict(mpl.rcParams) == before


def test_pictures_are_loaded_when_they_are_asked_for():
    check = (
        "import sys, understudy.figures as f; assert 'matplotlib' not in sys.modules; "
        "f.describe_task, f.layout, f.to_dot; assert 'matplotlib' not in sys.modules; "
        "f.draw_network; assert 'matplotlib' in sys.modules; assert 'matplotlib.pyplot' not in sys.modules"
    )
    subprocess.run([sys.executable, "-c", check], check=True)


def test_everything_exported_is_there():
    from understudy import figures

    assert {name: getattr(figures, name) for name in figures.__all__}.keys() == set(figures.__all__)
    homes = [name for names in figures._HOMES.values() for name in names]
    assert sorted(homes) == sorted(figures.__all__)
    with pytest.raises(AttributeError, match="draw_nothing"):
        figures.draw_nothing  # noqa: B018
