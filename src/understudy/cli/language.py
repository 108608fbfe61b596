"""``understudy language``"""

import json
import math
from itertools import islice
from pathlib import Path
from random import Random
from typing import Annotated, Any

import typer

from understudy.cli.options import Json, LibraryPlace
from understudy.cli.tasks import named_task

__all__ = ["command"]


def command(
    task: Annotated[Path, typer.Argument(help="A task document, or a task by its name.")],
    words: Annotated[int, typer.Option(min=0, help="Show so many words, the shortest first.")] = 10,
    length: Annotated[
        int | None, typer.Option(min=0, help="Only words of at most so many steps; needed to count without end.")
    ] = None,
    sample: Annotated[
        int | None, typer.Option(min=1, help="Show so many words drawn by chance instead, each as likely as any other.")
    ] = None,
    seed: Annotated[int, typer.Option(min=0, help="Of that chance.")] = 0,
    contains: Annotated[
        str | None,
        typer.Option(
            help='Ask whether it can be done in this order: "Track(orange), PickUp(orange)". Exit code 1 if not.'
        ),
    ] = None,
    compare: Annotated[Path | None, typer.Option(help="Compare it with another task.")] = None,
    check: Annotated[
        bool, typer.Option("--check", help="Check it for the rules that every task keeps. Exit code 1 if it does not.")
    ] = False,
    library: LibraryPlace = None,
    as_json: Json = False,
) -> None:
    """In which orders a task can be done (§3.6)."""
    from understudy.language import Language  # noqa: PLC0415

    asked = [given for given in (contains is not None, compare is not None, check, sample is not None) if given]
    if len(asked) > 1:
        raise typer.BadParameter(
            "--contains, --compare, --check and --sample are questions of their own; ask one of them"
        )
    named = named_task(task, library)
    document, network = named.task, named.network
    longest = math.inf if length is None else length
    if check:
        _check(network, document.name, as_json)
    elif contains is not None:
        _contains(Language(network), network, contains, as_json)
    elif compare is not None:
        _compare(Language(network), document.name, compare, library, as_json)
    else:
        _words(network, document.name, longest, words, sample, seed, as_json)


def _words(network: Any, name: str, longest: float, words: int, sample: int | None, seed: int, as_json: bool) -> None:
    from understudy.behaviors import installed_skills  # noqa: PLC0415
    from understudy.errors import LanguageError  # noqa: PLC0415
    from understudy.figures import describe_language  # noqa: PLC0415
    from understudy.language import Language  # noqa: PLC0415

    language, random = Language(network), Random(seed)
    if sample is None:
        shown = list(islice(language.words(longest=longest), words))
    else:
        shown = [language.sample(random, longest=longest) for _ in range(sample)]
    if not as_json:
        typer.echo(describe_language(name, network, language, installed_skills(), shown, longest=longest))
        return
    record: dict[str, Any] = {"task": name, "symbols": language.symbols, "words": shown}
    try:
        record |= {"count": language.count(longest=longest), "finite": language.finite}
    except LanguageError as error:
        record |= {"count": None, "finite": None, "problem": str(error)}
    typer.echo(json.dumps(record))


def _contains(language: Any, network: Any, text: str, as_json: bool) -> None:
    from understudy.figures import membership_in_words  # noqa: PLC0415
    from understudy.language import parse_word  # noqa: PLC0415

    membership = language.membership(parse_word(text, network))
    if as_json:
        record = {
            "word": membership.word,
            "member": membership.member,
            "begins": membership.begins,
            "allowed": membership.allowed,
            "complete": membership.complete,
        }
        typer.echo(json.dumps(record))
    else:
        typer.echo(membership_in_words(membership))
    raise typer.Exit(0 if membership.member else 1)


def _compare(language: Any, name: str, other: Path, library: str | None, as_json: bool) -> None:
    from understudy.figures import compared_in_words  # noqa: PLC0415
    from understudy.language import Language, compare  # noqa: PLC0415

    named = named_task(other, library)
    comparison = compare(language, Language(named.network))
    if as_json:
        record = {
            "relation": comparison.relation,
            "both": comparison.both,
            "only_first": comparison.only_first,
            "only_second": comparison.only_second,
        }
        typer.echo(json.dumps(record))
    else:
        second = named.task.name if named.task.name != name else str(other)
        typer.echo(compared_in_words(name, second, comparison))


def _check(network: Any, name: str, as_json: bool) -> None:
    from understudy.language import RULES, violations  # noqa: PLC0415

    found = violations(network)
    if as_json:
        record = {
            "task": name,
            "violations": [
                {
                    "rule": violation.rule.name,
                    "word": violation.word,
                    "components": violation.paths,
                    "offender": violation.offender or None,
                    "since": violation.since or None,
                    "problem": str(violation),
                }
                for violation in found
            ],
        }
        typer.echo(json.dumps(record))
    else:
        for violation in found:
            typer.echo(f"{violation.rule.name}, broken: {violation}")
        for rule in RULES:
            if rule.name not in [violation.rule.name for violation in found]:
                typer.echo(f"{rule.name}, kept: {rule.says}")
    raise typer.Exit(1 if found else 0)
