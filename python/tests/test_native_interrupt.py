"""Ctrl-C ends every long call within a second."""

from __future__ import annotations

import signal
import subprocess
import sys
import time
from pathlib import Path

import pytest

PREAMBLE = """
import signal
import sys
import numpy as np
import native_models as m
from givens import _native as native
def rows(k):
    return np.arange(1, k + 1) * 0.1, np.full((k, 1), 1.4)
t, z = rows({rows})
steps, flow = m.discrete(), m.continuous()
called = m.discrete(transition=m.called(m.transition))
choice = m.choose("sr-ckf")
solver = m.choose("cd-ckf2", "continuous", rtol=1e-13)
def track(model, choice):
    return (model, choice, m.MEAN, m.STD, 0.0, t, z, None, None)
# a process started in the background of a shell ignores SIGINT
signal.signal(signal.SIGINT, signal.default_int_handler)
print("ready", flush=True)
try:
    {call}
except KeyboardInterrupt:
    print("interrupted", flush=True)
"""

CALLS = {
    "filter": (3_000_000, 'native.run(*track(steps, choice)[:7], goal="filter")'),
    "adaptive": (300_000, 'native.run(*track(flow, solver)[:7], goal="filter")'),
    "one_long_gap": (
        1,
        "native.run(m.continuous(drift=m.called(m.drift)), "
        'm.choose("cd-ckf2", "continuous", rtol=1e-14, max_step=1e-3), m.MEAN, m.STD, 0.0, np.array([99.0]), z)',
    ),
    "smoother": (1_000_000, 'native.run(*track(steps, choice)[:7], goal="interval")'),
    "callback": (3_000_000, 'native.run(*track(called, choice)[:7], goal="filter")'),
    "batch": (200_000, "native.run_batch([track(steps, choice)] * 30, threads=2)"),
    "simulation": (300_000, "native.simulate(flow, m.MEAN, m.STD, 0.0, t, 1, 30, threads=2)"),
}


@pytest.mark.parametrize("name", CALLS)
def test_ctrl_c_ends_a_long_call_within_a_second(name: str) -> None:
    rows, call = CALLS[name]
    program = PREAMBLE.format(rows=rows, call=call)
    started = subprocess.Popen(
        [sys.executable, "-c", program], stdout=subprocess.PIPE, text=True, cwd=Path(__file__).parent
    )
    assert started.stdout is not None
    try:
        assert started.stdout.readline() == "ready\n"
        time.sleep(0.5)
        assert started.poll() is None, "the call was too short to be interrupted"
        started.send_signal(signal.SIGINT)
        sent = time.monotonic()
        assert started.stdout.readline() == "interrupted\n"
        assert time.monotonic() - sent < 1.0
    finally:
        started.kill()
        started.communicate()
