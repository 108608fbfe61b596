"""What all documents have in common: YAML or JSON, closed, frozen, and refused with a reason.

The file is read as text, then as plain data, then into models; whatever is wrong on the way becomes one line that names
the file, the place in it, and what would be valid there.
"""

import difflib
import json
import math
import os
from collections.abc import Hashable, Iterator, Mapping
from contextlib import contextmanager
from pathlib import Path
from typing import Annotated, Any, BinaryIO, ClassVar

import yaml
from pydantic import (
    BaseModel,
    BeforeValidator,
    ConfigDict,
    Field,
    GetJsonSchemaHandler,
    ValidationError,
    model_validator,
)
from pydantic.json_schema import JsonSchemaValue
from pydantic_core import CoreSchema, PydanticCustomError

from understudy.errors import DocumentError

__all__ = [
    "Name",
    "Part",
    "TextOrNumber",
    "expect_kind",
    "first_fault",
    "new_file",
    "parse_text",
    "path_text",
    "read_data",
    "write_new",
]

# libyaml is ten times faster than the reader in Python; it is missing where PyYAML was built without it.
_SafeLoader: Any = getattr(yaml, "CSafeLoader", yaml.SafeLoader)


class _Loader(_SafeLoader):  # type: ignore[misc]  # its base is chosen above
    """YAML's safe loader, which also refuses a key that is given twice."""

    def construct_mapping(self, node: yaml.MappingNode, deep: bool = False) -> dict[Hashable, Any]:
        seen: set[str] = set()
        for key, _ in node.value:
            if not isinstance(key, yaml.ScalarNode):
                raise yaml.constructor.ConstructorError(None, None, "a key must be a plain word", key.start_mark)
            if key.value in seen:
                raise yaml.constructor.ConstructorError(
                    None, None, f"the key {key.value!r} is given twice", key.start_mark
                )
            seen.add(key.value)
        mapping: dict[Hashable, Any] = super().construct_mapping(node, deep=deep)
        return mapping


def _text_or_number(given: Any) -> Any:
    fits = isinstance(given, str) or (isinstance(given, int | float) and not isinstance(given, bool))
    if not fits or (isinstance(given, float) and not math.isfinite(given)):
        raise PydanticCustomError(
            "text_or_number", "this must be text or a number, given {given}", {"given": repr(given)}
        )
    return given


Name = Annotated[str, Field(min_length=1, max_length=80, pattern=r"\S")]
"""What things are called in documents, and files after them."""

TextOrNumber = Annotated[str | float, BeforeValidator(_text_or_number)]
"""A parameter's value. The check comes before pydantic's union, whose own message would name both alternatives."""


class Part(BaseModel):
    """One mapping of the document.

    A part with a ``shorthand`` may also be written as that field's value alone: ``say: HERE`` instead of
    ``say: {word: HERE}``.
    """

    model_config = ConfigDict(extra="forbid", frozen=True, validate_by_alias=True, validate_by_name=True)

    shorthand: ClassVar[str | None] = None

    @model_validator(mode="before")
    @classmethod
    def _only_known_keys(cls, given: Any) -> Any:
        if not isinstance(given, Mapping):
            if cls.shorthand is not None and given is not None and not isinstance(given, Part):
                return {cls.shorthand: given}
            return given
        known = [field.alias or name for name, field in cls.model_fields.items()]
        for key in given:
            if key not in known and key not in cls.model_fields:
                close = difflib.get_close_matches(str(key), known, n=1, cutoff=0.5)
                hint = f"did you mean {close[0]!r}? " if close else ""
                raise PydanticCustomError(
                    "unknown_key",
                    "unknown key {key}; {hint}allowed here: {allowed}",
                    {"key": repr(key), "hint": hint, "allowed": ", ".join(known), "leaf": str(key)},
                )
        return given

    @classmethod
    def __get_pydantic_json_schema__(cls, core: CoreSchema, handler: GetJsonSchemaHandler) -> JsonSchemaValue:
        schema = handler(core)
        if cls.shorthand is None:
            return schema
        full = handler.resolve_ref_schema(schema)
        short = full["properties"][cls.shorthand]
        return {"anyOf": [short, schema], "title": full.get("title", cls.__name__)}


def read_data(path: str | Path, kind: type[DocumentError] = DocumentError) -> Any:
    """The plain data of a document: JSON if the file's name ends in ``.json``, YAML otherwise.

    Args:
        path: of the file.
        kind: the error to raise.

    Raises:
        DocumentError: the file cannot be read, is not text, or is not YAML or JSON.
    """
    path = Path(path)
    try:
        text = path.read_text(encoding="utf-8")
    except UnicodeDecodeError:
        raise kind("the file is no text in UTF-8, so it is no document", source=str(path)) from None
    except OSError as error:
        raise kind(f"the file cannot be read: {error.strerror or error}", source=str(path)) from None
    return parse_text(text, source=str(path), kind=kind, as_json=path.suffix.lower() == ".json")


def parse_text(text: str, *, source: str, kind: type[DocumentError] = DocumentError, as_json: bool = False) -> Any:
    """The plain data of a document's text.

    Args:
        text: YAML or JSON.
        source: the document's name, for messages.
        kind: the error to raise.
        as_json: it is JSON.

    Raises:
        DocumentError: it is not YAML or JSON, or gives a key twice.
    """
    try:
        return json.loads(text, object_pairs_hook=_once) if as_json else yaml.load(text, Loader=_Loader)  # noqa: S506
    except json.JSONDecodeError as error:
        place = f"line {error.lineno}, column {error.colno}"
        raise kind(f"this is no JSON: {error.msg}", source=source, path=place) from None
    except yaml.MarkedYAMLError as error:
        mark = error.problem_mark or error.context_mark
        place = f"line {mark.line + 1}, column {mark.column + 1}" if mark else ""
        raise kind(f"this is no YAML: {error.problem or error.context}", source=source, path=place) from None
    except RecursionError:
        raise kind("this is nested too deeply to be a document", source=source) from None
    except (yaml.YAMLError, ValueError) as error:  # ValueError: YAML's 2024-13-45, or a key given twice
        raise kind(f"this is no document: {' '.join(str(error).split())}", source=source) from None


def _once(pairs: list[tuple[str, Any]]) -> dict[str, Any]:
    found: dict[str, Any] = {}
    for key, value in pairs:
        if key in found:
            raise ValueError(f"the key {key!r} is given twice")
        found[key] = value
    return found


_USES = {
    "world": "use it with `understudy teach` or `understudy run --world`",
    "task": "use it with `understudy run` or `understudy show`",
    "intervals": "use it with `understudy learn`",
    "context": "use it with `understudy run --resume`",
    "experiment": "use it with `understudy experiment`",
    "archive": "use it with `understudy tasks import`",
    "robot": "use it with `understudy teach --robot` or `understudy run --robot`",
}


def expect_kind(data: Any, wanted: str, *, source: str, kind: type[DocumentError] = DocumentError) -> None:
    """Refuses a document of another kind by its first line.

    Args:
        data: the document's plain data.
        wanted: kind and version, ``task/1``.
        source: the document's name, for messages.
        kind: the error to raise.

    Raises:
        DocumentError: it is no mapping, or a document of another kind or version.
    """
    what = wanted.partition("/")[0]
    if not isinstance(data, Mapping):
        raise kind(
            f"a document of this kind is a mapping that begins with 'understudy: {wanted}', given {data!r:.80}",
            source=source,
        )
    given = data.get("understudy")
    if given == wanted:
        return
    other = str(given).partition("/")[0]
    hint = f"; {_USES[other]}" if other in _USES and other != what else f"; it begins with 'understudy: {wanted}'"
    raise kind(
        f"this is no {what} document: expected {wanted!r}, given {given!r}{hint}", source=source, path="understudy"
    )


def write_new(path: Path, text: str, kind: type[DocumentError] = DocumentError) -> None:
    """Writes a new file, all of it or nothing; an existing one is never touched.

    Raises:
        DocumentError: the file exists, or cannot be written.
    """
    with new_file(path, kind) as file:
        file.write(text.encode())


@contextmanager
def new_file(path: Path, kind: type[DocumentError] = DocumentError) -> Iterator[BinaryIO]:
    """A new file, to be written in the block: all of it, if that ends well, or nothing. None is ever overwritten.

    Raises:
        DocumentError: the file exists, or cannot be written.
    """
    part = path.with_name(f".{path.name}.{os.getpid()}.part")
    try:
        with part.open("xb") as file:
            yield file
        os.link(part, path)  # unlike a rename, it fails where the name is taken
    except FileExistsError:
        raise kind("this file exists already, and nothing is overwritten; name another", source=str(path)) from None
    except OSError as error:
        raise kind(f"this file cannot be written: {error.strerror}", source=str(path)) from None
    finally:
        part.unlink(missing_ok=True)


def path_text(location: tuple[int | str, ...]) -> str:
    """``("targets", 2, "color")`` as ``targets[2].color``."""
    text = ""
    for step in location:
        text += f"[{step}]" if isinstance(step, int) else f".{step}" if text else step
    return text


def first_fault(error: ValidationError, source: str, kind: type[DocumentError] = DocumentError) -> DocumentError:
    """The first problem that pydantic found, as one line with its path."""
    fault = error.errors(include_url=False)[0]
    context: dict[str, Any] = fault.get("ctx", {})
    location = fault["loc"]
    given = f"{fault['input']!r:.80}"
    match fault["type"]:
        case "unknown_key":
            problem, location = fault["msg"], (*location, context["leaf"])
        case "missing":
            problem = "this key is required and missing"
        case "enum" | "literal_error":
            allowed = context["expected"].replace("'", "").replace(" or ", ", ")
            problem = f"{given} is unknown here; choose one of: {allowed}"
        case "model_type" | "dict_type":
            problem = f"expected a mapping (key: value), given {given}"
        case "list_type":
            problem = f"expected a list, given {given}"
        case "too_short" if not fault["input"]:
            problem = "this is empty; it takes at least one"
        case "missing_argument" | "too_short" | "too_long" | "tuple_type" if not isinstance(fault["input"], str):
            problem = f"expected a list such as [x, y], given {given}"
        case "string_type":
            problem = f"this must be text; put it in quotes, given {given}"
        case "float_type" | "float_parsing":
            problem = f"this must be a number, given {given}"
        case _:
            message = fault["msg"]
            problem = f"{message[0].lower()}{message[1:]}" + ("" if "given" in message else f", given {given}")
    return kind(problem, source=source, path=path_text(location))
