"""Control over a real wire: how long from a laser's message to the command, with a 640×480 raw image at 15 Hz.

The simulated robot is published by a process of its own, in the time of the wall, and measures; the task is run by this
one.
"""

import multiprocessing
import os
import resource
import time
from dataclasses import replace
from multiprocessing.connection import Connection

import cv2
import numpy as np

from understudy.behaviors import installed_skills
from understudy.execution import Controller, go_on
from understudy.learning import learn
from understudy.perception import Perception
from understudy.recording import DEFAULT_TOPICS, ObservationEncoder, decode_message, encode_message, speeds_of
from understudy.robot import Command
from understudy.ros2 import Ros2Robot, find_robot, open_transport
from understudy.ros2.transport import COMMANDS, SENSORS, Publication
from understudy.sessions import Stage, teach
from understudy.sim import load_world, world_path

SECONDS = 30.0
DOMAIN = 97
SLOT_S = 1 / 30
"""Every third slot brings a sweep, every second one a picture."""
TWIST = "geometry_msgs/msg/Twist"
LOOPBACK = (
    "<CycloneDDS><Domain><General><Interfaces><NetworkInterface name='lo' multicast='true'/></Interfaces></General>"
    "</Domain></CycloneDDS>"
)


def publish(results: Connection) -> None:
    """The robot's side; sends the latencies in the end."""
    stage = Stage(load_world(world_path("transport")).model_copy(update={"teacher": None}))
    robot, transport = stage.robot, open_transport("cyclonedds", domain=DOMAIN)
    encoder = ObservationEncoder(robot.spec, live=True)
    told = transport.subscribe("/cmd_vel", TWIST, COMMANDS)
    gripper = transport.subscribe("/gripper/command", "std_msgs/msg/String", COMMANDS)
    publications: dict[str, Publication] = {}
    latencies: list[float] = []
    slot, sent_s, begun_s = 0, 0.0, time.monotonic()
    while not results.poll():
        observation = robot.sense()
        assert observation.image is not None
        picture = cv2.resize(observation.image, (640, 480), interpolation=cv2.INTER_NEAREST)
        messages = list(encoder.messages(replace(observation, time_s=1.0 + observation.time_s, image=picture)))
        for message in sorted(messages, key=lambda one: one.topic == DEFAULT_TOPICS.scan):
            picture_now = message.topic == DEFAULT_TOPICS.image
            if (picture_now and slot % 2) or (not picture_now and slot % 3):
                continue
            if message.topic not in publications:
                publications[message.topic] = transport.publish(message.topic, message.type, SENSORS)
            data = encode_message(message.message, message.type)
            sent_s = time.monotonic()
            publications[message.topic].publish(data)
        slot += 1
        waiting = slot % 3 == 1
        while (left_s := begun_s + slot * SLOT_S - time.monotonic()) > 0:
            transport.wait(left_s)
            gripper.take()  # or waiting would end at once, over and over
            for data in told.take():
                if waiting:
                    latencies.append(time.monotonic() - sent_s)
                    waiting = False
                linear, angular = speeds_of(decode_message(data, TWIST, where="/cmd_vel"), TWIST)
                robot.act(Command(linear=linear, angular=angular))
        if slot % 3 == 0:
            robot.wait()
    results.send(latencies)
    transport.close()


def main() -> None:
    os.environ["CYCLONEDDS_URI"] = LOOPBACK
    skills = installed_skills()
    network = learn(teach(load_world(world_path("transport")), skills).demonstration).network
    ours, theirs = multiprocessing.get_context("spawn").Pipe()
    process = multiprocessing.get_context("spawn").Process(target=publish, args=(theirs,))
    process.start()
    document = find_robot("pioneer").model_copy(update={"domain": DOMAIN, "clock": "wall"})
    try:
        with Ros2Robot(document) as robot:
            robot.connect(timeout_s=60.0)
            controller = Controller(network, skills, robot.spec, seed=1)
            perception = Perception(robot.spec, attention=controller.program.attention)
            before, begun_s = resource.getrusage(resource.RUSAGE_SELF), time.monotonic()
            report = go_on(robot, controller, perception, limit_s=SECONDS)
            after, seconds = resource.getrusage(resource.RUSAGE_SELF), time.monotonic() - begun_s
        ours.send("enough")
        latencies = np.array(ours.recv()) * 1000
    finally:
        process.kill()
    busy = after.ru_utime + after.ru_stime - before.ru_utime - before.ru_stime
    median, high, worst = np.percentile(latencies, [50, 99, 100])
    print(f"{report.duration_s:.0f} s of the transport task, 640x480 raw at 15 Hz, {len(latencies)} commands")
    print(f"from sweep to command, ms: median {median:.1f}, 99th percentile {high:.1f}, longest {worst:.1f}")
    print(f"of one core: {100 * busy / seconds:.0f} %")
