"""The bundled tasks, and those of the dissertation's chapter 3, as a person would write them in Python."""

from understudy.network import Network
from understudy.network.builder import (
    Step,
    achieved,
    all_of,
    any_order,
    build,
    case,
    choose,
    complete,
    directly,
    do,
    holding,
    holds,
    in_order,
    named,
    not_,
    part,
    possible,
    rivals,
    switch,
    timed_out,
    until,
    within,
)

__all__ = ["delivery", "hierarchical"]


def hierarchical() -> Network:
    """§3.5.3.3, Figure 3.10."""
    box = do("PickUp", named("pick-up-orange"), color="orange")
    gate = part(
        "go-through-gate",
        directly(
            do("Track", named("pass-yellow"), color="yellow", distance_m=0.5, angle_deg=180),
            do("Track", named("pass-light-orange"), color="light orange", distance_m=0.5, angle_deg=0),
        ),
    )
    transport = part(
        "object-transport",
        directly(
            do("Drop", named("drop-first")),
            do("Track", named("go-to-light-green"), color="light green", distance_m=0.9, angle_deg=0),
            holding(box, in_order(gate, green("go-to-green"))),
            do("Drop", named("drop-there")),
        ),
    )
    colors = ("pink", "light green", "yellow", "orange")
    visits = [do("Track", named(f"visit-{color.replace(' ', '-')}"), color=color) for color in colors]
    return build(in_order(transport, part("visit-targets", any_order(*visits))))


def green(id_: str) -> Step:
    return do("Track", named(id_), color="green", distance_m=0.6, angle_deg=90)


def delivery() -> Network:
    """§3.5.2, Figure 3.7."""
    localize = do("Localize", named("localize"))
    get_box = do("GetBox", named("get-box"), within(60, signal="box not found"), color="orange")
    to_door, open_door, go_through = through_the_door("home")
    go_home = do("GoTo", named("go-home"), place="home")
    taken_away = not_(possible("GetBox", color="orange"))
    return build(
        choose(
            "delivery",
            case(
                "deliver",
                holding(localize, in_order(get_box, directly(to_door, open_door, go_through), go_home)),
                # The box comes along, but for the opening of the door.
                holding(get_box, to_door, go_through, go_home),
                in_order(get_box, open_door),
                holding(go_through, go_home),
                rivals(get_box, open_door),
            ),
            case(
                "change-rooms",
                holding(
                    do("Localize", named("localize")),
                    choose(
                        "there",
                        case("to-other", directly(*through_the_door("other")), when=holds("Localize", room="home")),
                        case("to-home", directly(*through_the_door("home"))),
                    ),
                ),
            ),
            switch("deliver", "change-rooms", when=all_of(timed_out(get_box), taken_away)),
            switch("deliver", "deliver", when=all_of(achieved(get_box), taken_away)),
            switch("change-rooms", "deliver", when=complete()),
        )
    )


def through_the_door(room: str) -> tuple[Step, Step, Step]:
    there = until(holds("GoThroughDoor", room=room))
    return (
        do("GoTo", named("go-to-door"), there, place="door"),
        do("OpenDoor", named("open-door"), there),
        do("GoThroughDoor", named("go-through-door"), room=room),
    )
