"""DDS on the loopback interface only, and invisible to whatever else runs on this machine."""

import os
import uuid
from collections.abc import Iterator
from itertools import count

import pytest

_domains = count(1)


@pytest.fixture(scope="session", autouse=True)
def _loopback() -> Iterator[None]:
    config = (
        "<CycloneDDS><Domain>"
        "<General><Interfaces><NetworkInterface name='lo' multicast='true'/></Interfaces></General>"
        f"<Discovery><Tag>{uuid.uuid4()}</Tag></Discovery>"
        "</Domain></CycloneDDS>"
    )
    before = os.environ.get("CYCLONEDDS_URI")
    os.environ["CYCLONEDDS_URI"] = config
    yield
    if before is None:
        del os.environ["CYCLONEDDS_URI"]
    else:
        os.environ["CYCLONEDDS_URI"] = before


@pytest.fixture
def domain() -> int:
    """A ROS domain of the test's own."""
    return next(_domains)
