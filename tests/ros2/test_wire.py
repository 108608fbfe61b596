"""Two processes over DDS: the simulated robot served by one, taught, learned from and run by the other."""

import signal
import subprocess
from collections.abc import Iterator
from contextlib import contextmanager
from dataclasses import dataclass
from pathlib import Path

import pytest
from cyclonedds.domain import DomainParticipant
from cyclonedds.idl import IdlStruct
from cyclonedds.idl.types import float64
from cyclonedds.pub import DataWriter
from cyclonedds.sub import DataReader
from cyclonedds.topic import Topic
from rosbags.typesys.stores import ros2_humble as ros

from tests.cli.program import PROGRAM
from understudy.behaviors import installed_skills
from understudy.errors import RobotError
from understudy.learning import Lesson, learn
from understudy.network import Task, load_task, save_task, task_path
from understudy.recording import decode_message, encode_message
from understudy.robot import Cue
from understudy.ros2 import RobotDocument, Ros2Robot, find_robot, open_transport
from understudy.ros2.transport import COMMANDS, LATCHED, SENSORS, Transport
from understudy.sessions import await_start, perform_with, practise_with, recorded_demonstration, teach, teach_with
from understudy.sim import load_world, world_path

TWIST, STRING = "geometry_msgs/msg/Twist", "std_msgs/msg/String"
SKILLS = installed_skills()


@contextmanager
def served(*arguments: object) -> Iterator["subprocess.Popen[str]"]:
    """``understudy sim`` in a process of its own; ended in any case."""
    process = subprocess.Popen(
        [*PROGRAM, "sim", *map(str, arguments), "--ros2", "--transport", "cyclonedds"],
        stdout=subprocess.PIPE,
        stderr=subprocess.PIPE,
        text=True,
    )
    try:
        yield process
    finally:
        process.kill()
        process.communicate()


def pioneer(domain: int, **keys: object) -> RobotDocument:
    return find_robot("pioneer").model_copy(update={"domain": domain, "transport": "cyclonedds", **keys})


def structure(lesson: Lesson) -> tuple[object, ...]:
    network = lesson.network
    links = sorted((link.source, link.target, link.type) for link in network.links)
    return [(one.id, one.behavior, one.parameters.get("color")) for one in network.components], links


def test_taught_learned_and_run_over_the_wire(domain: int, tmp_path: Path) -> None:
    with served("transport", "--time", "lockstep", "--once", "--domain", domain) as process:
        document = pioneer(domain)
        with Ros2Robot(document) as robot:
            robot.connect(timeout_s=60.0)
            path = tmp_path / "transport.mcap"
            demonstration = teach_with(robot, document, SKILLS, name="transport", recording=path)
        assert process.wait(timeout=60) == 0
    lesson = learn(demonstration)
    assert demonstration.done
    assert structure(lesson) == structure(learn(teach(load_world(world_path("transport")), SKILLS).demonstration))
    # What was recorded says the same, and of which robot it is.
    assert recorded_demonstration(path, SKILLS).observations == demonstration.observations

    with served("transport", "--time", "lockstep", "--once", "--no-teacher", "--seed", 5, "--domain", domain):
        with Ros2Robot(document) as robot:
            robot.connect(timeout_s=60.0)
            report = perform_with(robot, document, "transport", lesson.network, SKILLS)
        assert report.done


def test_practised_over_the_wire(domain: int) -> None:
    _, network = load_task(task_path("practice"))
    with (
        served("practice", "--time", "lockstep", "--once", "--domain", domain),
        Ros2Robot(pioneer(domain)) as robot,
    ):
        robot.connect(timeout_s=60.0)
        report = practise_with(robot, robot.document, "practice", network, SKILLS)
    assert report.done
    assert [one.word for one in report.corrections] == [Cue.BAD, Cue.COME]
    assert [one.id for one in report.network.components] == ["track-green-1", "track-light-orange-1", "track-pink-1"]


def test_a_robot_whose_program_is_killed(domain: int) -> None:
    with (
        served("transport", "--time", "wall", "--no-teacher", "--domain", domain) as process,
        Ros2Robot(pioneer(domain, clock="wall")) as robot,
    ):
        robot.connect(timeout_s=60.0)
        process.kill()
        with pytest.raises(RobotError, match=r"/scan|/odom"):
            await_start(robot, lambda: False)


def speeds(transport: Transport, reader: object) -> list[float]:
    data = reader.take()  # type: ignore[attr-defined]
    return [decode_message(one, TWIST, where="").linear.x for one in data]  # type: ignore[attr-defined]


def test_a_signal_stops_the_robot_before_the_program_ends(domain: int, tmp_path: Path) -> None:
    (tmp_path / "robot.yaml").write_text(pioneer(domain).to_yaml(), encoding="utf-8")
    lesson = learn(teach(load_world(world_path("visit_targets")), SKILLS).demonstration)
    save_task(tmp_path / "task.yaml", Task.of("visit", lesson.network))
    listener = open_transport("cyclonedds", domain=domain)
    told = listener.subscribe("/cmd_vel", TWIST, COMMANDS)
    with served("visit_targets", "--time", "wall", "--no-teacher", "--domain", domain):
        process = subprocess.Popen(
            [*PROGRAM, "run", "task.yaml", "--robot", "robot.yaml", "--at-once"],
            cwd=tmp_path,
            stdout=subprocess.PIPE,
            stderr=subprocess.PIPE,
            text=True,
        )
        try:
            seen: list[float] = []
            while not any(seen) and process.poll() is None:
                listener.wait(1.0)
                seen += speeds(listener, told)
            assert any(seen)
            process.send_signal(signal.SIGTERM)
            _, complaints = process.communicate(timeout=60)
        finally:
            process.kill()
            process.communicate()
        seen = speeds(listener, told) or seen
    listener.close()
    assert process.returncode == 128 + signal.SIGTERM
    assert "Traceback" not in complaints
    assert seen[-1] == 0.0


@dataclass
class Vector(IdlStruct, typename="geometry_msgs.msg.dds_.Vector3_"):
    x: float64
    y: float64
    z: float64


@dataclass
class Twist(IdlStruct, typename="geometry_msgs.msg.dds_.Twist_"):
    linear: Vector
    angular: Vector


def test_a_node_of_another_maker_is_understood_both_ways(domain: int) -> None:
    """By the type as somebody else writes it down, with its name, fields and serialisation."""
    ours = open_transport("cyclonedds", domain=domain)
    out = ours.publish("/told", TWIST, COMMANDS)
    back = ours.subscribe("/sensed", TWIST, SENSORS)
    participant = DomainParticipant(domain)
    theirs = DataReader(participant, Topic(participant, "rt/told", Twist))
    writer = DataWriter(participant, Topic(participant, "rt/sensed", Twist))
    while not (ours.subscribers("/told") and ours.publishers("/sensed")):
        ours.wait(0.05)
    message = ros.geometry_msgs__msg__Twist(
        linear=ros.geometry_msgs__msg__Vector3(x=0.25, y=0.0, z=0.0),
        angular=ros.geometry_msgs__msg__Vector3(x=0.0, y=0.0, z=-1.5),
    )
    out.publish(encode_message(message, TWIST))
    heard = None
    while heard is None:
        heard = theirs.take_one(timeout=10**10)
    assert heard == Twist(linear=Vector(0.25, 0.0, 0.0), angular=Vector(0.0, 0.0, -1.5))
    assert ours.subscribers("/told")[0].type == TWIST
    writer.write(heard)
    assert ours.wait(60.0)
    (data,) = back.take()
    assert data == encode_message(message, TWIST)
    ours.close()


def test_what_is_latched_comes_to_those_who_come_later(domain: int) -> None:
    early, late = open_transport("cyclonedds", domain=domain), open_transport("cyclonedds", domain=domain)
    message = ros.std_msgs__msg__String(data="once and for all")
    early.publish("/said", STRING, LATCHED).publish(encode_message(message, STRING))
    reader = late.subscribe("/said", STRING, LATCHED)
    assert late.wait(60.0)
    (data,) = reader.take()
    assert decode_message(data, STRING, where="/said") == message
    assert late.publishers("/said")[0].latched
    assert late.published_topics() == ("/said",)
    early.close()
    while late.publishers("/said"):
        late.wait(0.05)
    late.close()
