"""Examples that Hypothesis draws: the same ones in every run, unless asked otherwise.

CDCR_RANDOM_TESTS=N draws other ones each time, N times as many; the nightly script does.
"""

import os

from hypothesis import settings

EXAMPLES = 60
FACTOR = int(os.environ.get("CDCR_RANDOM_TESTS", "0"))

settings.register_profile(
    "cdcr",
    derandomize=not FACTOR,
    database=None,
    deadline=None,
    print_blob=bool(FACTOR),
    max_examples=EXAMPLES * max(1, FACTOR),
)
settings.load_profile("cdcr")
