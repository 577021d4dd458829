"""The time of a recording on the page."""
from pathlib import Path

import page_node


def test_times_are_those_of_the_recording(tmp_path: Path) -> None:
    page_node.run(tmp_path, 'player.mjs')
