"""The task document: round trip, refusals, schema."""

from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from tests.execution.strategies import networks
from understudy.errors import NetworkError
from understudy.network import (
    Component,
    Interval,
    Link,
    LinkEvidence,
    LinkType,
    Network,
    Occurrence,
    Task,
    load_task,
    parse_task,
    save_task,
    task_schema,
)

FETCH = Network(
    components=(
        Component(
            id="track-green-1",
            behavior="Track",
            parameters={"color": "green", "distance_m": 0.6},
            occurrences=(
                Occurrence(
                    demonstration="monday",
                    interval=Interval(1.5, 9.25),
                    values={"distance_m": 0.6},
                    cues=((2.0, "HERE"),),
                    closest_s=8.0,
                ),
            ),
        ),
        Component(id="drop-1", behavior="Drop"),
    ),
    links=(
        Link(
            source="track-green-1",
            target="drop-1",
            type=LinkType.ENABLING,
            evidence=(
                LinkEvidence(
                    demonstration="monday",
                    source=Interval(1.5, 9.25),
                    target=Interval(9.0, 12.0),
                    relation="overlaps",
                    note="why",
                ),
            ),
        ),
    ),
    inhibitions=(("drop-1", "track-green-1"),),
)


@pytest.mark.parametrize("suffix", [".yaml", ".json"])
def test_a_task_comes_back_with_all_its_evidence(tmp_path: Path, suffix: str) -> None:
    path = tmp_path / f"fetch{suffix}"
    save_task(path, Task.of("fetch", FETCH, note="a note"))
    task, network = load_task(path)
    assert (task.name, task.note) == ("fetch", "a note")
    assert network == FETCH


@settings(max_examples=50)
@given(networks(), st.text(min_size=1, max_size=30).filter(str.strip))
def test_every_network_comes_back(network: Network, name: str) -> None:
    _, found = parse_task(Task.of(name, network).model_dump(mode="json", by_alias=True))
    assert found == network


def test_nothing_is_overwritten(tmp_path: Path) -> None:
    path = tmp_path / "fetch.yaml"
    save_task(path, Task.of("fetch", FETCH))
    before = path.read_bytes()
    with pytest.raises(NetworkError, match="exists already"):
        save_task(path, Task.of("other", FETCH))
    assert path.read_bytes() == before


def test_a_folder_that_is_not_there(tmp_path: Path) -> None:
    with pytest.raises(NetworkError, match="cannot be written: No such file"):
        save_task(tmp_path / "no" / "fetch.yaml", Task.of("fetch", FETCH))


def document(**changes: object) -> dict[str, object]:
    components = [{"id": "a", "behavior": "Track"}, {"id": "b", "behavior": "Drop"}]
    return {"understudy": "task/1", "name": "t", "components": components} | changes


@pytest.mark.parametrize(
    ("data", "path", "message"),
    [
        ([], "", "begins with 'understudy: task/1'"),
        ({"understudy": "world/1"}, "understudy", "expected 'task/1', given 'world/1'"),
        (document(componets=[]), "componets", "did you mean 'components'?"),
        (document(components=[]), "components", "at least one"),
        (
            document(components=[{"id": "a"}]),
            "components[0]",
            "exactly one of these keys is needed: behavior, network, ",
        ),
        (
            document(links=[{"from": "a", "to": "b", "type": "always"}]),
            "links[0].type",
            "ordering, enabling, permanent",
        ),
        (document(links=[{"from": "a", "to": "c", "type": "ordering"}]), "links[0].to", "no component is called 'c'"),
        (
            document(components=[{"id": "a", "behavior": "T", "parameters": {"x": [1]}}]),
            "components[0].parameters.x",
            "text or a number",
        ),
    ],
)
def test_faults_are_told_with_their_place(data: object, path: str, message: str) -> None:
    with pytest.raises(NetworkError) as caught:
        parse_task(data, source="t.yaml")
    assert (caught.value.source, caught.value.path) == ("t.yaml", path)
    assert message in caught.value.problem


@pytest.mark.parametrize(
    ("content", "message"),
    [(b"a: [", "no YAML"), (b"a: 1\na: 2", "'a' is given twice"), (b"\xff\xfe\xff", "no text in UTF-8")],
)
def test_files_that_are_no_documents(tmp_path: Path, content: bytes, message: str) -> None:
    path = tmp_path / "t.yaml"
    path.write_bytes(content)
    with pytest.raises(NetworkError, match=message):
        load_task(path)


def test_the_schema_has_the_keys_of_the_parser() -> None:
    assert set(task_schema()["properties"]) == set(Task.model_fields)
    assert task_schema()["additionalProperties"] is False
