"""The places of names on a plan."""
from pathlib import Path

import page_node


def test_names_leave_what_is_in_a_small_room(tmp_path: Path) -> None:
    page_node.run(tmp_path, 'places.mjs')
