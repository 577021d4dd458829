"""Checks a home's data: recomputes what follows from truth, track, states and layout."""
from __future__ import annotations

from pathlib import Path

from angen_apps.data.checks import files, labels, layout, places, sensors, tables
from angen_apps.data.tables import homes
from angen_apps.data.written import Findings, Written
from angen_tools.common.failure import Failure

SHOWN = 3  # findings of a kind that are listed


def validate_all(folder: Path, world: Path | None = None
                 ) -> tuple[Findings, dict[str, dict[str, float]]]:
    """Checks the homes of an output folder, and their list; the shares are by home. `world`:
    the file of a home of the user's own, which the data are of."""
    if world is not None and not world.is_file():
        raise Failure(f'{world}: is not a file that can be read')
    findings, shares, found = Findings(), {}, homes(folder)
    for home in found:
        own = validate(home, world)
        findings.add(own, home.name)
        shares[home.name] = own.shares
    files.check_folder(findings, folder, found)
    return findings, shares


def validate(folder: Path, world: Path | None = None) -> Findings:
    """Checks one home; `world` as above."""
    findings = Findings()
    home = Written(folder)
    for check in (files.check, places.check, labels.check, sensors.check, tables.check):
        check(findings, home)
    layout.check(findings, home, world)
    return findings
