"""The commands, and what they have in common: options, exit codes, errors in one line.

Exit codes: 0 done; 1 the robot did not do the task, or the answer is no; 2 wrong usage or input; 130 stopped by Ctrl-C.
"""

import os
import sys
from typing import Annotated

import typer

from understudy import __version__
from understudy.cli import (
    calibrate,
    demo,
    doctor,
    experiment,
    explain,
    export,
    generalize,
    language,
    learn,
    library,
    plan,
    practice,
    reassign,
    run,
    schema,
    show,
    sim,
    teach,
)
from understudy.errors import UnderstudyError

__all__ = ["app", "main"]

# Plain help: drawing it with Rich would take longer than everything else together.
app = typer.Typer(
    name="understudy",
    help="A robot that learns your task by following you, and gets better by practising it.",
    epilog="Start with: understudy demo",
    invoke_without_command=True,
    rich_markup_mode=None,
    pretty_exceptions_enable=False,
    context_settings={"help_option_names": ["-h", "--help"], "max_content_width": 100},
)


def _version(wanted: bool) -> None:
    if wanted:
        typer.echo(f"understudy {__version__}")
        raise typer.Exit


@app.callback()
def _main(
    context: typer.Context,
    version: Annotated[
        bool, typer.Option("--version", callback=_version, is_eager=True, help="Show the version and exit.")
    ] = False,
) -> None:
    if context.invoked_subcommand is None:
        typer.echo(context.get_help())


app.command("demo", help="Teach, learn and run a task from beginning to end, with pictures.")(demo.command)
app.command("teach", help="Give a demonstration in a world; writes a recording.")(teach.command)
app.command("learn", help="Learn a task from a recording, or from a plain file of observed intervals.")(learn.command)
app.command("plan", help="A task from a goal, such as carried(orange, pink).")(plan.command)
app.command("generalize", help="Add demonstrations to a task: alternatives, and what all have in common.")(
    generalize.command
)
app.command("run", help="Execute a task in a world; writes a recording and a report.")(run.command)
app.command("practice", help="Execute a task under the teacher's feedback; writes the corrected task.")(
    practice.command
)
app.command("reassign", help="A practice run's words were about other steps: makes the corrections again.")(
    reassign.command
)
app.command("show", help="A task in words, as a picture or as DOT; or what a recording shows.")(show.command)
app.command("explain", help="Why a step of a recorded run was active or not, and what would have made it so.")(
    explain.command
)
app.command("export", help="Write a recording as a rosbag2 folder.")(export.command)
app.command("language", help="In which orders a task can be done; counted, compared, checked.")(language.command)
app.command("experiment", help="Make the trials of an experiment, and tell how often the robot succeeds.")(
    experiment.command
)
app.add_typer(library.commands, name="tasks", help="The library: every task with all that it ever was.")
app.command("sim", help="Simulate a world whose robot other programs command over ROS 2.")(sim.command)
app.command("calibrate", help="Teach a robot's camera the eight colors.")(calibrate.command)
app.command("schema", help="Print the JSON Schema of a document.")(schema.command)
app.command("doctor", help="What is installed, what is missing, and how to mend it.")(doctor.command)


def main() -> None:
    """Runs the command line; the console script ``understudy``."""
    # The robot's pictures are so small that waking OpenCV's threads costs more than they save. Read when it is loaded.
    os.environ.setdefault("OPENCV_FOR_THREADS_NUM", "1")
    try:
        # Typer turns Ctrl-C into this exit code.
        code = app(prog_name="understudy", standalone_mode=False)
        if code == _INTERRUPTED:
            _complain("stopped by Ctrl-C; the robot stands still, and what was recorded until then is kept", code)
    except ImportError as error:
        if not _interrupted(error):
            raise
        code = _complain("stopped by Ctrl-C while starting; nothing was begun", _INTERRUPTED)
    except typer.TyperException as error:  # wrong usage
        context = getattr(error, "ctx", None)
        command = context.command_path if context else "understudy"
        code = _complain(f"{error.format_message()} (see {command} --help)", 2)
    except UnderstudyError as error:
        code = _complain(str(error), 2)
    except BrokenPipeError:
        # Whoever read our output has gone, as `| head` does; nothing is wrong.
        sys.stderr.close()
        code = 0
    except OSError as error:
        code = _complain(f"{error.filename or 'the standard output'}: {error.strerror or error}", 2)
    sys.exit(code or 0)


_INTERRUPTED = 130


def _interrupted(error: BaseException | None) -> bool:
    """Whether Ctrl-C is behind an error: compiled packages report it as a failed import."""
    while error is not None:
        if isinstance(error, KeyboardInterrupt):
            return True
        error = error.__cause__ or error.__context__
    return False


def _complain(problem: str, code: int) -> int:
    print(f"understudy: {problem}", file=sys.stderr)
    return code
