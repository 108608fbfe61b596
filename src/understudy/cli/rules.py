"""What commands say of a task that breaks a rule (§3.6)."""

from typing import TYPE_CHECKING

from understudy.errors import LanguageError

if TYPE_CHECKING:
    from understudy.network import Network

__all__ = ["broken_rules"]

_STATES = 20_000
"""A second's work at most; who wants to know of a larger task asks ``understudy language TASK --check``."""


def broken_rules(network: "Network") -> list[str]:
    """One sentence for each rule that a task can break; none for a task too large to be looked at on the way."""
    from understudy.language import violations  # noqa: PLC0415 - help must come at once

    try:
        return [str(violation) for violation in violations(network, limit=_STATES)]
    except LanguageError:
        return []
