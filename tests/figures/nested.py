"""Tasks with networks in networks, and with every control there is, as the pictures' tests need them."""

from tests.figures.samples import component, network
from understudy.execution.trace import Event
from understudy.network import (
    Achieved,
    After,
    AllOf,
    Case,
    Complete,
    Component,
    Happened,
    Holds,
    Nab,
    Network,
    Not,
    Possible,
    Repeat,
    Switch,
    TimedOut,
    Timeout,
    Trigger,
)


def track(id_, color, distance_m=0.6, angle_deg=90.0, **controls):
    parameters = {"color": color, "distance_m": distance_m, "angle_deg": angle_deg}
    return Component(id=id_, behavior="Track", parameters=parameters, **controls)


def hierarchical():
    """The task of §3.5.3.3: transport, with a gate as a network of its own, then four targets in any order."""
    gate = network(
        [track("yellow", "yellow", 0.5, 180.0), track("light-orange", "light orange", 0.5, 0.0)],
        [("yellow", "light-orange", "enabling")],
    )
    transport = network(
        [
            track("light-green", "light green"),
            component("pick-up", "PickUp", color="orange"),
            Nab.of("gate", gate, task="GoThroughGate"),
            track("green", "green"),
            component("drop", "Drop"),
        ],
        [
            ("light-green", "pick-up", "enabling"),
            ("pick-up", "gate", "permanent"),
            ("gate", "green", "ordering"),
            ("pick-up", "green", "permanent"),
            ("green", "drop", "enabling"),
        ],
    )
    colors = ("pink", "light green", "yellow", "orange")
    visit = network([track(color.replace(" ", "-"), color) for color in colors], [])
    return network(
        [Nab.of("transport", transport, task="Object transport"), Nab.of("visit", visit, task="Visit targets")],
        [("transport", "visit", "ordering")],
    )


def delivery():
    """Two cases with switches between them, as for the dissertation's delivery of §3.5.2.3."""
    fetch = network(
        [track("at-the-box", "green"), component("pick-up", "PickUp", color="orange")],
        [("at-the-box", "pick-up", "enabling")],
    )
    deliver = network(
        [track("at-the-door", "yellow"), track("at-the-goal", "pink"), component("drop", "Drop")],
        [("at-the-door", "at-the-goal", "enabling"), ("at-the-goal", "drop", "enabling")],
    )
    held = Holds(behavior="PickUp", parameters={"color": "orange"})
    nab = Nab(
        id="deliver",
        cases=(Case(name="loaded", network=deliver, when=held), Case(name="empty", network=fetch)),
        switches=(
            Switch(source="empty", target="loaded", when=Complete()),
            Switch(source="loaded", target="empty", when=AllOf(of=(Not(of=held), Not(of=Achieved(component="drop"))))),
        ),
        repeat=Repeat(times=3),
        task="Deliver a box",
    )
    return network(
        [track("start", "red"), nab, track("home", "blue", timeout=Timeout(seconds=60, then="skip"))],
        [("start", "deliver", "ordering"), ("deliver", "home", "ordering")],
    )


def rivals():
    """Steps that keep each other still: side by side, farther apart, from layer to layer, one way and both ways."""
    steps = [component("drop", "Drop"), *(track(color, color) for color in ("green", "yellow", "pink", "orange"))]
    steps += [track("red", "red"), component("pick-up", "PickUp", color="orange")]
    links = [("drop", color, "ordering") for color in ("green", "yellow", "pink", "orange")]
    links += [("green", "red", "ordering"), ("red", "pick-up", "permanent"), ("pink", "pick-up", "ordering")]
    made = network(steps, links)
    held_back = (("green", "yellow"), ("yellow", "green"), ("yellow", "orange"), ("red", "drop"), ("pick-up", "red"))
    return Network(made.components, made.links, held_back)


def controls():
    """Loops, ends, timeouts of all kinds, and duties of both kinds."""
    there = Possible(behavior="PickUp", parameters={"color": "orange"})
    rounds = network([track("pink", "pink"), track("red", "red")], [("pink", "red", "ordering")])
    greet = network([track("teacher", "blue"), component("drop", "Drop")], [("teacher", "drop", "enabling")])
    steps = (
        track("green", "green", until=Happened(event="come"), timeout=Timeout(seconds=45, then="skip")),
        Nab(
            id="patrol",
            cases=(Case(network=rounds),),
            repeat=Repeat(times=5, until=there),
            timeout=Timeout(seconds=120, then="signal", event="late"),
        ),
        Component(
            id="pick-up", behavior="PickUp", parameters={"color": "orange"}, timeout=Timeout(seconds=90, then="stop")
        ),
        track("look", "yellow", trigger=Trigger(every_s=30)),
        Nab(id="greet", cases=(Case(network=greet),), trigger=Trigger(on=Happened(event="bell"))),
    )
    made = network(steps, [("green", "patrol", "ordering"), ("patrol", "pick-up", "enabling")])
    return Network(made.components, made.links, (("look", "patrol"),))


def deep(levels=4):
    """A network in a network in a network."""
    inner = network([track("green", "green"), component("drop", "Drop")], [("green", "drop", "permanent")])
    for level in range(levels):
        parts = [track("before", "red"), Nab.of(f"level-{level}", inner), component("after", "Drop")]
        inner = network(parts, [("before", f"level-{level}", "enabling"), (f"level-{level}", "after", "ordering")])
    return inner


def branches():
    """Cases that fall through, that are reached by switches only, and with long conditions."""
    timed = network([track("a", "red", timeout=Timeout(seconds=20, then="skip"))], [])
    plain = network([track("b", "pink"), track("c", "green")], [("b", "c", "ordering")])
    seen = Possible(behavior="Track", parameters={"color": "red"})
    box = Possible(behavior="PickUp", parameters={"color": "light orange"})
    nab = Nab(
        id="choose",
        cases=(
            Case(name="near", network=timed, when=AllOf(of=(seen, Not(of=box)))),
            Case(name="box", network=plain, when=box),
            Case(name="rest", network=plain),
            Case(name="give up", network=timed),
        ),
        switches=(
            Switch(source="near", target="give up", when=TimedOut(component="a")),
            Switch(source="box", target="near", when=seen),
            Switch(source="rest", target="box", when=After(seconds=30)),
            Switch(source="rest", target="rest", when=Happened(event="again, please")),
        ),
    )
    only = Nab(id="perhaps", cases=(Case(network=plain, when=box),))
    return network([nab, only], [("choose", "perhaps", "ordering")])


def large(count=60):
    """Sixty steps in ten networks."""
    colors = ("yellow", "orange", "red", "light green", "pink", "green")
    parts = []
    for index in range(count // 6):
        steps = [track(f"t{step}", colors[(index + step) % 6]) for step in range(6)]
        links = [(f"t{a}", f"t{a + 1}", "ordering") for a in range(5) if index % 3 or a % 2]
        parts.append(Nab.of(f"room-{index + 1}", network(steps, links)))
    kinds = ("ordering", "enabling", "permanent")
    pairs = [(a, a + by) for a in range(len(parts)) for by in (1, 3) if a + by < len(parts)]
    return network(parts, [(f"room-{a + 1}", f"room-{b + 1}", kinds[(a + b) % 3]) for a, b in pairs])


def run_of_controls():
    """A trace of :func:`controls` in which everything happens that can be told of."""
    told = [
        (0, "state", "green", {"state": "executing"}),
        (0, "state", "look", {"state": "resting"}),
        (0, "state", "greet/teacher", {"state": "unused"}),
        (45, "timeout", "green", {"then": "skip"}),
        (45, "state", "green", {"state": "skipped"}),
        (45, "state", "patrol", {"state": "executing"}),
        (45, "state", "patrol/pink", {"state": "searching"}),
        (30, "called", "look", {}),
        (50, "state", "look", {"state": "executing"}),
        (50, "state", "patrol", {"state": "inhibited", "by": "look"}),
        (58, "goal", "look", {"holds": True}),
        (58, "achieved", "look", {"on_purpose": True}),
        (58, "state", "look", {"state": "resting"}),
        (58, "state", "patrol", {"state": "executing"}),
        (58, "state", "patrol/pink", {"state": "executing"}),
        (64, "goal", "patrol/pink", {"holds": True}),
        (64, "achieved", "patrol/pink", {"on_purpose": True}),
        (64, "state", "patrol/pink", {"state": "achieved"}),
        (64, "state", "patrol/red", {"state": "executing"}),
        (68, "goal", "patrol/pink", {"holds": False}),
        (75, "achieved", "patrol/red", {"on_purpose": True}),
        (75, "round", "patrol", {"number": 2}),
        (75, "state", "patrol/red", {"state": "waiting"}),
        (75, "state", "patrol/pink", {"state": "executing"}),
        (80, "event", "", {"name": "bell"}),
        (80, "called", "greet", {}),
        (80, "state", "greet", {"state": "executing"}),
        (80, "state", "greet/teacher", {"state": "executing"}),
        (86, "achieved", "greet/teacher", {"on_purpose": True}),
        (86, "state", "greet/teacher", {"state": "achieved"}),
        (86, "achieved", "greet/drop", {"on_purpose": False}),
        (86, "achieved", "greet", {"on_purpose": True}),
        (86, "state", "greet", {"state": "resting"}),
        (90, "achieved", "patrol/pink", {"on_purpose": True}),
        (90, "state", "patrol/pink", {"state": "achieved"}),
        (90, "state", "patrol/red", {"state": "executing"}),
        (99, "achieved", "patrol/red", {"on_purpose": True}),
        (99, "goal", "patrol", {"holds": True}),
        (99, "achieved", "patrol", {"on_purpose": True}),
        (99, "state", "patrol", {"state": "achieved"}),
        (99, "state", "patrol/red", {"state": "achieved"}),
        (99, "state", "pick-up", {"state": "executing"}),
        (112, "goal", "pick-up", {"holds": True}),
        (112, "achieved", "pick-up", {"on_purpose": True}),
        (112, "state", "pick-up", {"state": "achieved"}),
        (112, "complete", "", {}),
    ]
    return [
        Event(time_s=float(time_s), kind=kind, component=path, detail=detail) for time_s, kind, path, detail in told
    ]


def run_of_delivery():
    """A trace of :func:`delivery`: the box is fetched, lost on the way, fetched again and delivered."""
    events = []
    switches = ((8, "case", {"case": "empty"}), (25, "switch", {"to": "loaded"}), (38, "switch", {"to": "empty"}))
    for time_s, kind, detail in (*switches, (52, "switch", {"to": "loaded"})):
        events.append(Event(time_s=float(time_s), kind=kind, component="deliver", detail=detail))
    reached = [("start", 8), ("deliver/empty/at-the-box", 16), ("deliver/empty/pick-up", 25)]
    reached += [("deliver/loaded/at-the-door", 33), ("deliver/empty/at-the-box", 44), ("deliver/empty/pick-up", 52)]
    reached += [("deliver/loaded/at-the-door", 60), ("deliver/loaded/at-the-goal", 70)]
    begin = 0.0
    for path, time_s in reached:
        events.append(Event(time_s=begin, kind="state", component=path, detail={"state": "executing"}))
        begin = float(time_s)
        events.append(Event(time_s=begin, kind="achieved", component=path, detail={"on_purpose": True}))
        events.append(Event(time_s=begin, kind="state", component=path, detail={"state": "achieved"}))
    return events
