import json
from pathlib import Path

import pytest
from hypothesis import given
from hypothesis import strategies as st

from understudy.errors import DocumentError, LearningError
from understudy.learning import Instance, intervals_schema, learn, load_intervals, parse_intervals
from understudy.network import Interval
from understudy.robot.cues import Cue

from .build import typed_links

BREAKFAST = """\
understudy: intervals/1
name: breakfast
intervals:
  - {label: Boil water, start: 0, end: 95.5}
  - {label: Grind beans, start: 10, end: 40}
  - {label: Fold filter, start: 40.02, end: 50}
  - {label: Pour, start: 97, end: 104, parameters: {into: cup, tilt: 30}}
  - {label: Pour, start: 110, end: 112}
"""


def document(**changes: object) -> dict[str, object]:
    return {"understudy": "intervals/1", "name": "d", "intervals": [{"label": "a", "start": 0, "end": 1}]} | changes


def steps(*entries: dict[str, object]) -> dict[str, object]:
    return document(intervals=[{"label": "a", "start": 0, "end": 1}, *entries])


def test_a_breakfast_is_learned(tmp_path: Path) -> None:
    path = tmp_path / "breakfast.yaml"
    path.write_text(BREAKFAST, encoding="utf-8")
    lesson = learn(load_intervals(path))
    assert lesson.demonstration == "breakfast"
    assert typed_links(lesson.network) == {
        ("boil-water-1", "grind-beans-1"): "permanent",
        ("boil-water-1", "fold-filter-1"): "permanent",
        ("grind-beans-1", "fold-filter-1"): "enabling",
        ("fold-filter-1", "pour-cup-1"): "ordering",
        ("pour-cup-1", "pour-1"): "ordering",
    }
    assert lesson.network.by_id["pour-cup-1"].parameters == {"into": "cup", "tilt": 30.0}
    assert lesson.dropped == ()


def test_json_reads_the_same(tmp_path: Path) -> None:
    path = tmp_path / "d.json"
    path.write_text(json.dumps(document(cues=[{"time": 0.5, "cue": "HERE"}])), encoding="utf-8")
    demonstration = load_intervals(path)
    assert demonstration == parse_intervals(document(cues=[{"time": 0.5, "cue": "HERE"}]))
    assert demonstration.cues == ((0.5, Cue.HERE),)
    assert demonstration.annotated


def test_the_steps_come_in_the_order_of_their_onsets() -> None:
    found = parse_intervals(steps({"label": "c", "start": -3, "end": 9}, {"label": "b", "start": 0, "end": 0}))
    assert [observed.instance.behavior for observed in found.observations] == ["c", "a", "b"]
    assert found.span == Interval(-3, 9)


def test_words_tell_kinds_apart_and_numbers_do_not() -> None:
    entry = {"label": "b", "start": 0, "end": 1, "parameters": {"hand": "left", "force": 3, "depth": 0.5}}
    observed = parse_intervals(document(intervals=[entry])).observations[0]
    assert observed.instance == Instance("b", (("hand", "left"),))
    assert observed.values == {"force": 3.0, "depth": 0.5}
    assert observed.history is None


step = {"label": "b", "start": 0, "end": 1}


@pytest.mark.parametrize(
    ("data", "path", "message"),
    [
        (
            steps(step, {"label": "b", "start": 5, "end": 4}),
            "intervals[2].end",
            "'b' ends at 4 s, before it begins at 5",
        ),
        (steps({"label": "b", "start": 0}), "intervals[1].end", "this key is required and missing"),
        (
            steps({**step, "lable": "x"}),
            "intervals[1].lable",
            "unknown key 'lable'; did you mean 'label'? allowed here: label, start, end, parameters",
        ),
        (steps({**step, "label": True}), "intervals[1].label", "must be text; put it in quotes, given True"),
        (steps({**step, "start": "0"}), "intervals[1].start", "must be a number, given '0'"),
        (steps({**step, "end": float("inf")}), "intervals[1].end", "given inf"),
        (steps({**step, "end": 1e300}), "intervals[1].end", r"less than or equal to 1000000000000, given 1e+300"),
        (
            steps({**step, "parameters": {"n": None}}),
            "intervals[1].parameters.n",
            "must be text or a number, given None",
        ),
        (steps({**step, "parameters": 3}), "intervals[1].parameters", "expected a mapping (key: value), given 3"),
        (
            document(cues=[{"time": 1, "cue": "START"}]),
            "cues[0].cue",
            "'START' is unknown here; choose one of: HERE, TAKE, DROP",
        ),
        (document(cues=[{"time": 1, "word": "HERE"}]), "cues[0].word", "unknown key 'word'; allowed here: time, cue"),
        (document(understudy="intervals/2"), "understudy", "expected 'intervals/1', given 'intervals/2'"),
        (document(mood="good"), "mood", "unknown key 'mood'; allowed here: understudy, name, intervals, cues"),
        (document(name=""), "name", "at least 1 character"),
        ([1, 2], "", "a mapping that begins with 'understudy: intervals/1', given [1, 2]"),
        (steps(7), "intervals[1]", "expected a mapping (key: value), given 7"),  # type: ignore[arg-type]
        (None, "", "given None"),
    ],
)
def test_faults_are_told_with_their_place(data: object, path: str, message: str) -> None:
    with pytest.raises(DocumentError) as caught:
        parse_intervals(data, source="tea.yaml")
    assert (caught.value.source, caught.value.path) == ("tea.yaml", path)
    assert message in caught.value.problem


@pytest.mark.parametrize(
    ("name", "content", "message"),
    [
        ("a.yaml", b"intervals: [", "this is no YAML: did not find expected node content"),
        ("a.yaml", b"name: 2024-13-45", "this is no document: month must be in 1..12"),
        ("a.json", b"{", "this is no JSON: Expecting property name"),
        ("a.yaml", b"\xff\xfe\xff", "no text in UTF-8"),
    ],
)
def test_files_that_are_no_documents(tmp_path: Path, name: str, content: bytes, message: str) -> None:
    path = tmp_path / name
    path.write_bytes(content)
    with pytest.raises(DocumentError, match=message) as caught:
        load_intervals(path)
    assert caught.value.source == str(path)


def test_a_missing_file(tmp_path: Path) -> None:
    with pytest.raises(DocumentError, match="the file cannot be read: No such file"):
        load_intervals(tmp_path / "no.yaml")


def test_an_empty_list_cannot_be_learned_from() -> None:
    with pytest.raises(LearningError, match="nothing to learn from; list the steps"):
        parse_intervals(document(intervals=[]))


json_values = st.recursive(
    st.none() | st.booleans() | st.integers() | st.floats() | st.sampled_from(["HERE", "intervals/1", "a", ""]),
    lambda inner: (
        st.lists(inner, max_size=3)
        | st.dictionaries(
            st.sampled_from(["understudy", "name", "intervals", "cues", "label", "start", "end", "parameters", "cue"]),
            inner,
            max_size=5,
        )
    ),
    max_leaves=15,
)


def fault_in(data: object) -> DocumentError | LearningError | None:
    try:
        parse_intervals(data)
    except (DocumentError, LearningError) as error:
        return error
    return None


@given(json_values)
def test_whatever_is_no_document_is_refused_by_name_and_place(data: object) -> None:
    error = fault_in(data)
    assert error is None or str(error).startswith("intervals: ")


@given(
    st.sampled_from(["understudy", "name", "intervals", "cues"]),
    json_values,
)
def test_also_where_only_one_part_is_wrong(key: str, value: object) -> None:
    error = fault_in(document(**{key: value}))
    assert not isinstance(error, DocumentError) or error.path.startswith(key)


def test_the_schema_knows_the_keys_of_the_parser() -> None:
    schema = intervals_schema()
    assert schema["additionalProperties"] is False
    assert set(schema["properties"]) == {"understudy", "name", "intervals", "cues"}
    assert set(schema["required"]) == {"understudy", "name", "intervals"}
    interval = schema["$defs"]["IntervalEntry"]
    assert interval["additionalProperties"] is False
    assert set(interval["required"]) == {"label", "start", "end"}
    assert schema["$defs"]["CueEntry"]["properties"]["cue"]["enum"] == ["HERE", "TAKE", "DROP", "REPEAT", "UNTIL"]
