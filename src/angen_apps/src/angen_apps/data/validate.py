"""Checks a home's data: recomputes what follows from truth, track, states and layout."""
from __future__ import annotations

from pathlib import Path

from angen_apps.data.checks import files, labels, places, sensors
from angen_apps.data.written import Findings, Written

SHOWN = 3  # findings of a kind that are listed


def validate(folder: Path) -> Findings:
    """Checks one home."""
    findings = Findings()
    home = Written(folder)
    for check in (files.check, places.check, labels.check, sensors.check):
        check(findings, home)
    return findings
