"""What the doctor says of a robot's topics."""

from tests.ros2.network import Base, Network, Node
from understudy.robot import PIONEER
from understudy.ros2 import RobotDocument, TopicFinding, examine
from understudy.ros2.transport import SENSORS


def examined(base: Base, **keys: object) -> dict[str, TopicFinding]:
    network = base.network
    document = RobotDocument.model_validate(keys)
    found = examine(document, Node(network, "doctor"), seconds=3.0, clock=network.clock)
    return {one.what: one for one in found}


def test_a_healthy_robot() -> None:
    found = examined(Base(Network(), PIONEER), gripper={}, camera={"field_deg": 48.8})
    assert all(one.ok for one in found.values())
    laser, speeds = found["laser"], found["speeds"]
    assert laser.rate_hz is not None
    assert 9.0 < laser.rate_hz < 11.0
    assert laser.age_s is not None
    assert laser.age_s < 0.2
    assert laser.told() == "/scan: sensor_msgs/msg/LaserScan, best effort, 10.0 Hz, 0.0 s ago"
    assert speeds.told() == "/cmd_vel: geometry_msgs/msg/Twist, reliable"
    assert not found["emergency stop"].ends
    assert {"gripper", "gripper's joints", "gripper's beam"} <= found.keys()


def test_what_is_missing_is_told_with_the_mend() -> None:
    base = Base(Network())
    base.die()
    found = examined(base)
    assert {what for what, one in found.items() if not one.ok} == {"camera", "odometry", "laser", "speeds"}
    assert found["laser"].told() == "/scan: nobody publishes it"
    assert "name another topic as laser.topic" in found["laser"].fault
    assert "nobody listens to /cmd_vel" in found["speeds"].fault


def test_a_slow_laser_a_second_one_and_words_that_cannot_be_heard() -> None:
    base = Base(Network())
    Node(base.network, "second").publish("/odom", "nav_msgs/msg/Odometry", SENSORS)
    Node(base.network, "teacher").publish("/cues", "std_msgs/msg/String", SENSORS)
    base.change = lambda observation: observation if base.steps % 4 == 0 else None
    found = examined(base)
    assert "comes 2.5 times a second, and the robot needs 4" in found["laser"].fault
    assert "2 programs publish /odom; stop all but one" in found["odometry"].fault
    assert "publish it reliably" in found["teacher's words"].fault
    assert not found["teacher's words"].ok


def test_readings_that_cannot_be_used_are_told_once() -> None:
    base = Base(Network())
    found = examined(base, camera={"width": 160, "rows": 90})
    assert "put a size of this shape into its document" in found["readings"].fault
    assert not found["readings"].ok


def test_a_camera_that_sees_another_field_than_the_document_says() -> None:
    base = Base(Network())
    found = examined(base, camera={"field_deg": 50})
    assert "tells of a field of 69.0°, and the document of 50°; put `field_deg: 69.0` there" in found["readings"].fault
    assert "readings" not in examined(Base(Network()), camera={"field_deg": 50, "info": None})


def test_nothing_is_published() -> None:
    base = Base(Network(), PIONEER)
    examined(base, gripper={})
    assert "/cmd_vel" not in base.network.sent
    assert "/gripper/command" not in base.network.sent
