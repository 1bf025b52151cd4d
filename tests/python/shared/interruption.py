"""Ctrl-C during a computation."""

import signal
import time
from collections.abc import Callable, Iterator
from contextlib import contextmanager

DELAY = 0.2  # [s]


@contextmanager
def interrupt_soon() -> Iterator[Callable[[], float]]:
    """Do what Ctrl-C does after a moment; gives a function that tells the work since then [s].

    An alarm of the system, which waits for no thread of Python, handled as Ctrl-C is. SIGINT
    itself is ignored where the tests run in the background. The work is that of the processor,
    which a busy machine does not add to.
    """
    before = signal.signal(signal.SIGALRM, signal.default_int_handler)
    began = time.process_time()
    # Again, much later, where the first was lost: no test waits for ever.
    signal.setitimer(signal.ITIMER_REAL, DELAY, 300 * DELAY)
    try:
        yield lambda: time.process_time() - began - DELAY
    finally:
        signal.setitimer(signal.ITIMER_REAL, 0.0)
        signal.signal(signal.SIGALRM, before)
