"""The command line. Every command imports what it needs when it is called, so that help comes at once."""

__all__ = ["main"]


def main() -> None:
    """Runs the command line."""
    from understudy.cli.app import main as run  # noqa: PLC0415 - this package's import must stay cheap

    run()
