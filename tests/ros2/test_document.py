"""Robot documents: what may be left out, what is refused, and that the schema agrees."""

import re
from pathlib import Path
from typing import Any

import pytest
import yaml

from understudy.errors import RobotDocumentError
from understudy.robot import TURTLEBOT
from understudy.ros2 import RobotDocument, find_robot, load_robot, parse_robot, robot_names, robot_schema


def refused(**keys: Any) -> str:
    with pytest.raises(RobotDocumentError) as raised:
        parse_robot({"understudy": "robot/1"} | keys, source="robot.yaml")
    message = str(raised.value)
    assert message.startswith("robot.yaml: ")
    assert "\n" not in message
    return message


def test_everything_but_the_kind_may_be_left_out() -> None:
    document = parse_robot({"understudy": "robot/1"}, source="robot.yaml")
    spec = document.spec
    assert (spec.length, spec.max_linear, spec.camera.height) == (
        TURTLEBOT.length,
        TURTLEBOT.max_linear,
        TURTLEBOT.camera.height,
    )
    assert spec.camera.field == pytest.approx(TURTLEBOT.camera.field)
    assert document.topics.scan == "/scan"
    assert document.topics.gripper_command is None


@pytest.mark.parametrize(
    ("keys", "says"),
    [
        ({"laser": {"topc": "/scan"}}, "laser.topc: unknown key 'topc'; did you mean 'topic'?"),
        ({"laser": {"topic": "scan"}}, "laser.topic"),
        ({"drive": {"message": "Twist2"}}, "choose one of: detect, Twist, TwistStamped"),
        ({"limits": {"linear": 0}}, "limits.linear"),
        ({"gripper": {"finger": {"joint": "f", "low": 1, "high": 1}}}, "two different positions"),
        ({"domain": 300}, "domain"),
        ({"clock": "moon"}, "choose one of: wall, sim"),
        ({"understudy": "world/1"}, "use it with `understudy teach` or"),
        ({"sonar": {"poses": []}}, "sonar.poses"),
    ],
)
def test_mistakes_are_refused_with_their_place(keys: dict[str, Any], says: str) -> None:
    assert says in refused(**keys)


@pytest.mark.parametrize("name", robot_names())
def test_a_document_comes_back_from_its_text(name: str, tmp_path: Path) -> None:
    document = find_robot(name)
    path = tmp_path / "robot.yaml"
    path.write_text(document.to_yaml(), encoding="utf-8")
    assert load_robot(path) == document
    assert load_robot(path).spec == document.spec


def test_a_robot_that_is_nowhere(tmp_path: Path) -> None:
    with pytest.raises(RobotDocumentError, match="no such robot among: pioneer, turtlebot"):
        find_robot("r2d2")
    with pytest.raises(RobotDocumentError, match="cannot be read"):
        find_robot(tmp_path / "r2d2.yaml")


PAGE = Path(__file__).parents[2] / "docs" / "ros2.md"
EXAMPLES = re.findall(r"```yaml\n(.*?)```", PAGE.read_text(encoding="utf-8"), re.DOTALL)


@pytest.mark.parametrize("text", EXAMPLES)
def test_the_examples_of_the_page_are_robots(text: str) -> None:
    assert parse_robot(yaml.safe_load(text), source="ros2.md").spec.name == "my robot"


def test_the_page_names_every_key() -> None:
    page = PAGE.read_text(encoding="utf-8")
    assert EXAMPLES
    for key in RobotDocument.model_fields:
        assert key in ("understudy", "name", "note") or key in page


def test_the_schema_knows_every_key() -> None:
    schema = robot_schema()
    assert set(schema["properties"]) == set(RobotDocument.model_fields)
    assert schema["additionalProperties"] is False
    assert set(yaml.safe_load(RobotDocument().to_yaml())) == set(schema["properties"])
