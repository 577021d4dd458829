"""angen import: reads a plan of any known kind and writes a world."""
from __future__ import annotations

import argparse
from pathlib import Path

from angen_apps.imports.rmf import read_rmf
from angen_apps.imports.sweethome import read_sweethome
from angen_apps.plan.model import Plan
from angen_apps.plan.writer import write_world

SHOWN = 20  # remarks


def read_plan(path: Path, args: argparse.Namespace) -> Plan:
    """The plan of a file, by its ending."""
    if path.suffix.lower() in ('.yaml', '.yml'):
        return read_rmf(path)
    return read_sweethome(path, args.things)


def import_home(path: Path, output: Path, args: argparse.Namespace) -> str:
    """Writes the world; returns what is to print: counts, and what was not read as it is."""
    plan = read_plan(path, args)
    counts = write_world(plan, output, args.sensors)
    words = ', '.join(f'{number} {name if number != 1 else name[:-1]}'
                      for name, number in counts.items() if number)
    lines = [f'wrote {output}: {words}']
    lines += [f'remark: {remark}' for remark in plan.remarks[:SHOWN]]
    if len(plan.remarks) > SHOWN:
        lines.append(f'and {len(plan.remarks) - SHOWN} more remarks')
    return '\n'.join(lines)
