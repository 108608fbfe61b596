"""The transport over rclpy, with a stand-in for the module: its calls, and the order of what it hands over."""

from types import SimpleNamespace

from tests.ros2 import stand_in_rclpy as fake
from understudy.ros2.transport import COMMANDS, LATCHED, SENSORS, Endpoint

SCAN = "sensor_msgs/msg/LaserScan"


def end(topic: str, *, node: str, publishes: bool) -> SimpleNamespace:
    qos = SimpleNamespace(reliability=fake.Reliability.RELIABLE, durability=fake.Durability.VOLATILE)
    return SimpleNamespace(topic=topic, topic_type=SCAN, node_name=node, qos_profile=qos, publishes=publishes)


def test_it_does_what_the_other_one_does() -> None:
    with fake.installed() as done:
        from understudy.ros2.ros_client import RosClientTransport

        transport = RosClientTransport(7, "understudy")
        (node,) = done.nodes
        assert done.inits[0]["domain_id"] == 7
        assert done.inits[0]["signal_handler_options"] == "no"
        scans = transport.subscribe("/scan", SCAN, SENSORS)
        words = transport.subscribe("/cues", "std_msgs/msg/String", COMMANDS)
        told = transport.publish("/cmd_vel", "geometry_msgs/msg/Twist", LATCHED)
        kind, scanned, profile = node.subscriptions["/scan"]
        assert (kind, profile.reliability, profile.depth) == (SCAN, fake.Reliability.BEST_EFFORT, 5)
        assert node.publishers[0].qos.durability is fake.Durability.TRANSIENT_LOCAL

        assert not transport.wait(0.0)
        heard = node.subscriptions["/cues"][1]
        for number in range(7):
            node.pending.append(lambda number=number: scanned(bytes([number])))
        node.pending.append(lambda: heard(b"HERE"))
        assert transport.wait(1.0)
        assert scans.take() == [bytes([number]) for number in range(2, 7)]  # the newest, up to the depth
        assert words.take() == [b"HERE"]
        assert not transport.wait(0.0)

        told.publish(b"slowly")
        assert node.publishers[0].published == [b"slowly"]
        transport.close()
        assert node.publishers[0].acknowledged
        assert node.destroyed
        assert done.shutdowns == 1


def test_others_are_told_from_itself() -> None:
    with fake.installed() as done:
        from understudy.ros2.ros_client import RosClientTransport

        transport = RosClientTransport(0, "understudy")
        (node,) = done.nodes
        node.others = [
            end("/scan", node="lidar", publishes=True),
            end("/scan", node=node.name, publishes=True),
            end("/cmd_vel", node="base", publishes=False),
        ]
        assert transport.publishers("/scan") == (Endpoint(topic="/scan", type=SCAN, reliable=True, latched=False),)
        assert len(transport.subscribers("/cmd_vel")) == 1
        assert transport.published_topics() == ("/scan",)
