"""The tasks, rooms and runs of the dissertation, as the pictures' tests need them."""

import itertools

import numpy as np

from understudy.execution.trace import Event
from understudy.figures import Trajectory
from understudy.learning import Demonstration, History, Instance, Observed
from understudy.network import Component, Interval, Link, LinkType, Network
from understudy.robot import Cue
from understudy.sim.world import World

VISITED = ("yellow", "orange", "red", "light green", "pink", "green")


def component(id_, behavior, **parameters):
    return Component(id=id_, behavior=behavior, parameters=parameters)


def network(components, links):
    return Network(tuple(components), tuple(Link(source=a, target=b, type=LinkType(kind)) for a, b, kind in links))


def transport():
    return network(
        [
            component("drop-1", "Drop"),
            component("green", "Track", color="green", distance_m=0.52, angle_deg=88.0),
            component("pick-up", "PickUp", color="orange"),
            component("yellow", "Track", color="yellow", distance_m=0.5, angle_deg=178.0),
            component("light-orange", "Track", color="light orange", distance_m=0.41, angle_deg=2.0),
            component("orange", "Track", color="orange", distance_m=0.61, angle_deg=91.0),
            component("drop-2", "Drop"),
        ],
        [
            ("drop-1", "green", "permanent"),
            ("drop-1", "pick-up", "enabling"),
            ("green", "pick-up", "enabling"),
            ("pick-up", "yellow", "permanent"),
            ("pick-up", "light-orange", "permanent"),
            ("pick-up", "orange", "permanent"),
            ("pick-up", "drop-2", "enabling"),
            ("yellow", "light-orange", "enabling"),
            ("light-orange", "orange", "ordering"),
            ("orange", "drop-2", "ordering"),
        ],
    )


def visit():
    steps = [component(color, "Track", color=color, distance_m=0.5, angle_deg=90.0) for color in VISITED]
    return network(steps, [(a, b, "ordering") for a, b in itertools.pairwise(VISITED)])


def pancakes():
    labels = [
        "Take out a blender from the cupboard under the sink",
        "Add-1 cup flour to a blender",
        "Add-1/2 tsp baking powder to a blender",
        "Add-1 pinch of salt to a blender",
        "blend for 10 seconds",
        "Pour batter into the hot pan",
    ]
    steps = [component(f"s{index}", text) for index, text in enumerate(labels)]
    links = [("s0", f"s{index}", "ordering") for index in (1, 2, 3)]
    links += [("s1", "s4", "ordering"), ("s2", "s4", "ordering"), ("s3", "s4", "enabling"), ("s4", "s5", "permanent")]
    return network(steps, links)


def wide(count=9):
    steps = [component("first", "Drop")]
    steps += [component(f"t{index}", "Track", color=VISITED[index % 6]) for index in range(count)]
    steps.append(component("last", "PickUp", color="light orange"))
    kinds = list(LinkType)
    links = [("first", f"t{index}", kinds[index % 3]) for index in range(count)]
    return network(steps, links + [(f"t{index}", "last", kinds[(index + 1) % 3]) for index in range(count)])


def layered():
    """Fifteen steps with links across one, two and five layers."""
    kinds = list(LinkType)
    steps = [component(f"c{index}", "Track", color=VISITED[index % 6]) for index in range(15)]
    pairs = [(a, a + by) for a in range(15) for by in (1, 2, 7) if a + by < 15 and (a * by) % 4 != 1]
    return network(steps, [(f"c{a}", f"c{b}", kinds[(a + b) % 3]) for a, b in pairs])


def single():
    return network([component("only", "Track", color="red")], [])


def loose(count=9):
    return network([component(f"c{index}", "Track", color=VISITED[index % 6]) for index in range(count)], [])


def run(task, *, begin=0.0):
    """A trace in which every step searches for 2 s and executes for 5 s; the first goal holds from the beginning."""
    events = []

    def add(time_s, kind, id_="", **detail):
        events.append(Event(time_s=time_s, kind=kind, component=id_, detail=detail))

    now = begin
    for index, id_ in enumerate(task.topological_order):
        if index:
            add(now, "state", id_, state="searching")
            add(now + 2.0, "state", id_, state="executing")
            now += 7.0
        add(now, "goal", id_, holds=True)
        add(now, "achieved", id_, on_purpose=bool(index))
        add(now, "state", id_, state="achieved")
        now += 1.0
        if id_.startswith(VISITED):
            add(now, "goal", id_, holds=False)
    add(now, "complete")
    return events, now - begin


def room(**changes):
    data = {
        "understudy": "world/1",
        "name": "fetch through a gate",
        "seed": 1,
        "arena": {"size": [4, 6]},
        "walls": [{"from": [0, 3.3], "to": [0.9, 3.3]}, {"from": [2.9, 3.3], "to": [4, 3.3]}],
        "targets": [
            {"color": "green", "at": [3.2, 0.9]},
            {"color": "yellow", "at": [1.25, 3.3]},
            {"color": "light orange", "at": [2.4, 3.3]},
            {"color": "orange", "at": [1.0, 5.2]},
        ],
        "boxes": [{"color": "orange", "at": [2.75, 1.35], "heading_deg": 20}],
        "robots": [{"name": "robot", "at": [0.7, 0.7], "heading_deg": 40}],
    }
    return World.from_data(data | changes)


def drive():
    part = np.linspace(0, 1, 400)
    return Trajectory(name="robot", points=np.column_stack([80 * part, 0.7 + 1.2 * np.sin(3 * part), 0.7 + 3.9 * part]))


def tracked(color, start, end, distance, angle):
    times = np.arange(start, end, 0.1)
    metres = distance + np.abs(times - (start + end) / 2) / 10
    return Observed(
        instance=Instance("Track", (("color", color),)),
        interval=Interval(start, end),
        values={"distance_m": distance, "angle_deg": angle},
        history=History(
            names=("distance_m", "angle_deg"), times=times, values=np.column_stack([metres, angle + 0 * times])
        ),
    )


def demonstration(*, begin=0.0):
    def seen(behavior, start, end, **parameters):
        instance = Instance(behavior, tuple(parameters.items()))
        return Observed(instance=instance, interval=Interval(begin + start, begin + end))

    return Demonstration(
        name="fetch",
        span=Interval(begin, begin + 64),
        observations=(
            seen("Drop", 0, 18.4),
            tracked("green", begin + 5.1, begin + 20.3, 0.52, 88.0),
            tracked("red", begin + 8.0, begin + 9.2, 1.4, 60.0),
            seen("PickUp", 18.9, 58.8, color="orange"),
            tracked("yellow", begin + 26.0, begin + 37.5, 0.5, 178.0),
            tracked("pink", begin + 42.0, begin + 47.5, 1.5, 120.0),
            tracked("orange", begin + 44.0, begin + 62.0, 0.61, 91.0),
            seen("Drop", 59.2, 64),
        ),
        cues=tuple(
            (begin + time, cue)
            for time, cue in ((12.8, Cue.HERE), (14.0, Cue.TAKE), (36.0, Cue.HERE), (55.5, Cue.HERE), (57.0, Cue.DROP))
        ),
    )
