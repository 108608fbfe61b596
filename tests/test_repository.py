"""What holds of the whole: import contracts, explicit exports, documents that agree, nothing that does not belong."""

import importlib
import pkgutil
import re
import subprocess
import sys
from pathlib import Path

import pytest

import understudy

ROOT = Path(__file__).parent.parent
MODULES = sorted(
    module.name
    for module in pkgutil.walk_packages(understudy.__path__, "understudy.")
    # The one is a program; the other needs ROS 2, which no package index has, and is tested with a stand-in for it.
    if "__main__" not in module.name and module.name != "understudy.ros2.ros_client"
)


def test_imports_point_upward_only() -> None:
    program = Path(sys.executable).with_name("lint-imports")
    done = subprocess.run([program], cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stdout


@pytest.mark.parametrize("name", MODULES)
def test_exports_are_explicit_and_there(name: str) -> None:
    module = importlib.import_module(name)
    assert len(module.__all__) == len(set(module.__all__))
    for exported in module.__all__:
        assert hasattr(module, exported), exported


@pytest.mark.parametrize("name", [name for name in MODULES if "." in name and name.count(".") == 1])
def test_a_room_offers_only_what_its_files_export(name: str) -> None:
    room = importlib.import_module(name)
    if not hasattr(room, "__path__"):
        return
    files = [
        importlib.import_module(module.name)
        for module in pkgutil.iter_modules(room.__path__, f"{name}.")
        if module.name in MODULES
    ]
    offered = {exported for file in files for exported in file.__all__}
    assert set(room.__all__) <= offered


def tracked() -> list[Path]:
    done = subprocess.run(["git", "ls-files"], cwd=ROOT, capture_output=True, text=True, check=False)
    if done.returncode:
        pytest.skip("this is no checkout")
    return [ROOT / line for line in done.stdout.splitlines()]


def test_no_registry_and_no_machine_is_named() -> None:
    hosts = re.compile(
        r"https?://[\w.-]*(pypi|pythonhosted|registry|npmjs|conda|anaconda|/simple)[\w./-]*", re.IGNORECASE
    )
    paths = re.compile(r"(?<![\w.])/(root|home|Users|work)/")
    for path in tracked():
        if path.suffix in (".png", ".svg") or path == Path(__file__) or not path.exists():
            continue
        text = path.read_text(encoding="utf-8")
        assert not hosts.search(text), path
        assert not paths.search(text), path


def test_the_lock_files_pin_everything_with_hashes() -> None:
    for lock in (ROOT / "requirements").glob("*.lock"):
        text = lock.read_text(encoding="utf-8")
        assert "http" not in text
        pins = [line for line in text.splitlines() if line and not line.startswith((" ", "#"))]
        assert all(re.match(r"[\w.\[\]-]+==[\w.]+( ;.*)? \\$", line) for line in pins), pins
        assert text.count("--hash=sha256:") >= len(pins)


def test_the_version_is_said_once() -> None:
    pyproject = (ROOT / "pyproject.toml").read_text(encoding="utf-8")
    assert f'version = "{understudy.__version__}"' in pyproject


def test_every_link_in_the_docs_leads_somewhere() -> None:
    for page in [ROOT / "README.md", *sorted((ROOT / "docs").glob("*.md"))]:
        for target in re.findall(r"\]\(([^)#]+)(?:#[^)]*)?\)", page.read_text(encoding="utf-8")):
            if not target.startswith("http"):
                assert (page.parent / target).exists(), f"{page.name}: {target}"


def test_every_command_of_the_readme_exists() -> None:
    readme = (ROOT / "README.md").read_text(encoding="utf-8")
    makefile = (ROOT / "Makefile").read_text(encoding="utf-8")
    for verb in re.findall(r"`?make (\w+)", readme):
        if verb not in ("demo", "test", "check", "bench", "trials", "clean"):
            continue
        assert re.search(rf"^{verb}:", makefile, re.MULTILINE), verb


def test_nothing_is_left_to_be_filled_in() -> None:
    for page in [ROOT / "README.md", ROOT / "CHANGELOG.md", *sorted((ROOT / "docs").glob("*.md"))]:
        assert not re.search(r"^(TRIALS|BENCH|TODO|TBD)$", page.read_text(encoding="utf-8"), re.MULTILINE), page
