"""The output of angen replay."""
from pathlib import Path

import angen

from angen_tools.offline.replay import replay

EMPTY = '<sdf version="1.6"><world name="w"/></sdf>'


def test_a_log_without_a_fingerprint_is_not_called_equal(tmp_path: Path) -> None:
    world = tmp_path / 'empty.world'
    world.write_text(EMPTY)
    log = tmp_path / 'run.log'
    angen.World(str(world), record=str(log)).run(2.0)
    assert 'all 3 fingerprints are equal' in replay(str(log), leap=True)['text']
    log.write_text(log.read_text().splitlines(keepends=True)[0])
    assert 'without a fingerprint to compare' in replay(str(log), leap=True)['text']
