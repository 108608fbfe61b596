"""``understudy doctor``"""

import json
import platform
import sys
from importlib.metadata import PackageNotFoundError, version
from typing import Annotated

import typer

from understudy.cli import onboard
from understudy.cli.options import Json

__all__ = ["command"]

_NEEDED = {
    "mujoco-core": "the simulator",
    "opencv-python-headless": "the robot's eyes",
    "numpy": "everything",
    "pydantic": "documents",
    "mcap": "recordings",
    "rosbags": "ROS 2 messages in recordings",
    "matplotlib": "pictures",
    "scipy": "statistics of trials",
    "sqlalchemy": "the library of tasks",
    "typer": "the command line",
    "rich": "progress bars",
    "pyyaml": "documents",
}
_OPTIONAL = {
    "unified-planning": "tasks from goals",
    "up-pyperplan": "tasks from goals",
    "up-fast-downward": "tasks from goals, another planner",
    "distributed": "trials on many workers",
    "jinja2": "reports as pages",
    "cyclonedds": "ROS 2 robots, without ROS",
}


def command(
    robot: onboard.Robot = None,
    seconds: Annotated[float, typer.Option(min=0.5, help="With --robot: how long to listen.")] = 5.0,
    as_json: Json = False,
) -> None:
    """Checks the installation, or with --robot a robot's topics. Exit code 1 if something is missing."""
    findings = _topics(robot, seconds) if robot is not None else _installation()
    if as_json:
        typer.echo(json.dumps(findings))
    else:
        for finding in findings:
            typer.echo(f"{'ok ' if finding['ok'] else 'BAD'}  {finding['what']:<24} {finding['found']}")
            if finding["mend"]:
                typer.echo(f"     mend: {finding['mend']}")
    raise typer.Exit(0 if all(finding["ok"] for finding in findings) else 1)


def _installation() -> list[dict[str, object]]:
    return [
        _python(),
        *(_package(name, purpose) for name, purpose in _NEEDED.items()),
        *(_extra(name, purpose) for name, purpose in _OPTIONAL.items()),
        _simulator(),
        _skills(),
    ]


def _topics(robot: str, seconds: float) -> list[dict[str, object]]:
    """Every input and output of a robot, and which skills bind on it."""
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.ros2 import examine, find_robot, open_transport  # noqa: PLC0415
    from understudy.sessions import capabilities  # noqa: PLC0415

    document = find_robot(robot)
    transport = open_transport(document.transport, domain=document.domain)
    try:
        found = examine(document, transport, seconds=seconds)
    finally:
        transport.close()
    topics = [
        _finding(one.what, one.ok, one.told(), one.fault) | ({"topic": one.as_record()} if one.topic else {})
        for one in found
    ]
    bound = capabilities(installed_skills(), document.spec)
    return [
        *topics,
        *(
            _finding(one.skill, True, f"does not bind: needs {one.missing}" if one.missing else "binds")
            for one in bound
        ),
    ]


def _finding(what: str, ok: bool, found: str, mend: str = "") -> dict[str, object]:
    return {"what": what, "ok": ok, "found": found, "mend": "" if ok else mend}


def _python() -> dict[str, object]:
    return _finding("Python", sys.version_info >= (3, 11), platform.python_version(), "install Python 3.11 or newer")


def _package(name: str, purpose: str) -> dict[str, object]:
    try:
        return _finding(name, True, f"{version(name)} ({purpose})")
    except PackageNotFoundError:
        return _finding(name, False, f"missing ({purpose})", "install understudy anew: pip install understudy")


def _extra(name: str, purpose: str) -> dict[str, object]:
    """A package without which only its purpose is missing."""
    try:
        return _finding(name, True, f"{version(name)} ({purpose})")
    except PackageNotFoundError:
        return _finding(name, True, f"not installed, and not needed but for this: {purpose}; pip install {name}")


def _simulator() -> dict[str, object]:
    try:
        from understudy.sim import Simulation, load_world, world_path  # noqa: PLC0415

        simulation = Simulation(load_world(world_path("transport")))
        simulation.robot().sense()
        simulation.step()
    except (ImportError, OSError, RuntimeError) as error:
        return _finding("simulated robot", False, str(error), "install understudy anew: pip install understudy")
    return _finding("simulated robot", True, "senses and moves")


def _skills() -> dict[str, object]:
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.errors import SkillError  # noqa: PLC0415

    try:
        return _finding("skills", True, ", ".join(installed_skills()))
    except SkillError as error:
        return _finding("skills", False, str(error), "update or remove the package that offers this skill")
