"""The one folder that a command writes to: names are never reused, so nothing is overwritten."""

from pathlib import Path

from understudy.errors import UnderstudyError

__all__ = ["Workspace", "file_stem"]


def file_stem(name: str) -> str:
    """A name as part of a file's name: ``Visit targets!`` becomes ``visit-targets``."""
    words = "".join(character if character.isalnum() else " " for character in name.lower()).split()
    return "-".join(words) or "unnamed"


class Workspace:
    """A folder, made when it is first needed.

    Args:
        folder: where it is, or shall be.

    Raises:
        UnderstudyError: it cannot be made, or is no folder.
    """

    def __init__(self, folder: str | Path) -> None:
        self.folder = Path(folder)
        try:
            self.folder.mkdir(parents=True, exist_ok=True)
        except OSError as error:
            raise UnderstudyError(
                f"the workspace {self.folder} cannot be made ({error.strerror}); name another with --workspace"
            ) from None

    def free(self, stem: str, *suffixes: str) -> Path:
        """A path without suffix under which no file with one of the suffixes exists: ``fetch``, else ``fetch-2``, …"""
        stem, number = file_stem(stem), 1
        while True:
            path = self.folder / (stem if number == 1 else f"{stem}-{number}")
            if not any(path.with_name(path.name + suffix).exists() for suffix in suffixes):
                return path
            number += 1
