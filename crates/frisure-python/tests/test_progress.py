"""Progress, exceptions of callbacks, and Ctrl-C."""

from __future__ import annotations

import _thread
import importlib.util
import os
import signal
import subprocess
import sys
import threading
import time
from collections.abc import Callable, Iterator

import frisure
import numpy as np
import pytest

from conftest import SMALL

LONG = {"hair": {"type": "caucasian-curly", "length": "25 cm"}}
"""A head that takes many seconds."""


def test_progress_is_reported_by_stage() -> None:
    heard: list[tuple[str, float]] = []
    frisure.predict({**SMALL, "seed": 2}, progress=lambda stage, done: heard.append((stage, done)))
    assert heard and all(0 <= done <= 1 for _, done in heard)
    assert len({stage for stage, _ in heard}) >= 2


def test_an_exception_of_the_callback_ends_the_work() -> None:
    class Enough(Exception):
        pass

    def stop(stage: str, done: float) -> None:
        raise Enough(stage)

    start = time.monotonic()
    with pytest.raises(Enough):
        frisure.predict(LONG, progress=stop)
    with pytest.raises(TypeError):
        frisure.predict(LONG, progress=lambda: None)  # type: ignore[arg-type, misc]
    with pytest.raises(TypeError):
        frisure.predict(LONG, progress=3)  # type: ignore[arg-type]
    # No limit of speed: the whole work would take many times as long.
    assert time.monotonic() - start < 30
    assert len(frisure.predict(SMALL).strands) == 200


@pytest.fixture
def ctrl_c() -> Iterator[None]:
    """Python's handler of Ctrl-C: a shell lets what it starts in the background ignore it."""
    before = signal.signal(signal.SIGINT, signal.default_int_handler)
    yield
    signal.signal(signal.SIGINT, before)


@pytest.mark.usefixtures("ctrl_c")
def test_ctrl_c_ends_the_work_soon() -> None:
    sent: list[float] = []

    def press() -> None:
        time.sleep(0.4)
        sent.append(time.monotonic())
        _thread.interrupt_main(signal.SIGINT)

    works: list[Callable[[], object]] = [
        lambda: frisure.predict(LONG),
        lambda: frisure.rods.settle([0.15] * 400_000, curl_radius=5e-3, elements=240),
        # The rods of this one take longer to make than the time until the key is pressed.
        lambda: frisure.rods.settle(np.broadcast_to(0.15, (3_000_000,)), elements=2, points=False),
    ]
    if importlib.util.find_spec("pyarrow"):
        works.append(lambda: frisure.batch({"samples": 1000, "volume": False, "set": {"wisps.count": 30}}))
    for work in works:
        sent.clear()
        thread = threading.Thread(target=press)
        thread.start()
        with pytest.raises(KeyboardInterrupt):
            work()
        waited = time.monotonic() - sent[0]
        thread.join()
        print(f"Ctrl-C after {waited:.3f} s")
        # 0.2 s on a machine with nothing else to do; a loaded one may be late.
        assert waited < 2


def test_other_threads_run_meanwhile() -> None:
    counted = 0
    done = threading.Event()

    def count() -> None:
        nonlocal counted
        while not done.is_set():
            counted += 1
            time.sleep(0.001)

    thread = threading.Thread(target=count)
    thread.start()
    frisure.predict({**SMALL, "seed": 3})
    done.set()
    thread.join()
    assert counted > 10


def test_hairstyles_can_be_made_in_several_threads() -> None:
    made: list[frisure.Hairstyle] = []
    hair = frisure.predict(SMALL)
    work = [lambda: made.append(hair.wet()), lambda: made.append(hair.comb("left"))]
    threads = [threading.Thread(target=one) for one in work]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(made) == 2


FORK = """
import os, sys, numpy as np, frisure
from frisure import rods
STARTED
child = os.fork()
if child == 0:
    code = 3
    try:
        code = 0 if len(rods.settle(np.full(1000, 0.1))) == 1000 else 4
    except frisure.FailedError as error:
        print(error, flush=True)
        code = 7
    os._exit(code)
sys.exit(os.waitstatus_to_exitcode(os.waitpid(child, 0)[1]))
"""


@pytest.mark.skipif(not hasattr(os, "fork"), reason="there are no forks")
@pytest.mark.parametrize(("started", "code"), [("rods.settle(np.full(1000, 0.1))", 7), ("", 0)])
def test_a_fork_without_threads_is_told_and_does_not_wait(started: str, code: int) -> None:
    program = [sys.executable, "-c", FORK.replace("STARTED", started)]
    ran = subprocess.run(program, capture_output=True, text=True, check=False, timeout=60)
    assert ran.returncode == code, ran.stderr
    assert ("start method \"spawn\"" in ran.stdout) == (code == 7), ran.stdout
