"""``understudy sim``"""

import time as wall
from typing import Annotated, Literal

import typer

from understudy.cli.onboard import stopped_by_signals
from understudy.cli.options import Seed
from understudy.cli.worlds import find_world

__all__ = ["command"]


def command(
    world: Annotated[str, typer.Argument(help="A world document, or a bundled one.")],
    ros2: Annotated[bool, typer.Option("--ros2", help="Offer its robot to ROS 2, under the usual topics.")] = False,
    time: Annotated[
        Literal["wall", "sim", "lockstep"],
        typer.Option(
            help="As fast as the wall clock, with its stamps or with those of /clock; or one step for each command."
        ),
    ] = "wall",
    stamped: Annotated[
        bool, typer.Option("--stamped", help="Take speeds as TwistStamped instead of as Twist.")
    ] = False,
    domain: Annotated[
        int | None, typer.Option(min=0, max=232, help="The ROS domain; ROS_DOMAIN_ID, or 0, if not given.")
    ] = None,
    transport: Annotated[
        Literal["detect", "cyclonedds", "rclpy"], typer.Option(help="By which way to speak ROS 2.")
    ] = "detect",
    seed: Seed = None,
    teacher: Annotated[
        bool, typer.Option("--teacher/--no-teacher", help="With the teacher of the world, who leads the robot.")
    ] = True,
    once: Annotated[bool, typer.Option("--once", help="End when whoever commanded the robot has gone.")] = False,
) -> None:
    """Simulates a world whose robot other programs command. Ends with Ctrl-C; exit code 1 if the robot hit anything."""
    if not ros2:
        raise typer.BadParameter("nobody could command this robot; offer it with --ros2")
    from understudy.ros2 import Served, open_transport  # noqa: PLC0415 - help must come at once
    from understudy.sessions import Stage  # noqa: PLC0415

    room = find_world(world)
    if not teacher:
        room = room.model_copy(update={"teacher": None})
    stage = Stage(room, seed)
    network = open_transport(transport, domain=domain, node="understudy_sim")
    served = Served(stage.robot, network, time=time, stamped=stamped, epoch_s=wall.time())
    typer.echo(f"{stage.robot.spec.name} in {room.name} is on ROS 2; end with Ctrl-C", err=True)
    try:
        with stopped_by_signals():
            served.run(until=lambda: once and served.deserted)
    finally:
        network.close()
    verdict = stage.verdict()
    hits = ", ".join(f"{count} × {what}" for what, count in verdict.collisions.items())
    typer.echo(f"{stage.simulation.time_s:.1f} s simulated; " + (f"it hit {hits}" if hits else "nothing was hit"))
    raise typer.Exit(1 if hits else 0)
