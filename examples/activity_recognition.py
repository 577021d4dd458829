#!/usr/bin/env python3
"""Learns activities from the motion sensors of two homes and recognizes them in a third.

    ./angen shell -c "python3 examples/activity_recognition.py --days 30 -o out"
"""
import argparse
import subprocess
from pathlib import Path

import numpy as np
import pandas as pd
from sklearn.dummy import DummyClassifier
from sklearn.ensemble import RandomForestClassifier
from sklearn.metrics import ConfusionMatrixDisplay, confusion_matrix, f1_score

WINDOW = '60s'
GROUPS = {'cook': 'kitchen', 'wash_dishes': 'kitchen', 'take_medicine': 'kitchen', 'snack': 'eat',
          'eat': 'eat', 'toilet': 'bathroom', 'wash': 'bathroom', 'shower': 'bathroom',
          'sleep': 'sleep', 'nap': 'relax', 'read': 'relax', 'relax': 'relax',
          'watch_tv': 'watch TV', 'leave': 'out', 'work': 'work', 'study': 'work'}
USES = ('kitchen', 'living', 'bedroom', 'bathroom', 'work', 'hall')


def windows(home: Path) -> tuple[pd.DataFrame, pd.Series]:
    """Features and the activity of each minute of a home with one resident."""
    layout = pd.read_json(home / 'layout.json', typ='series')
    use = {room['name']: room['use'] for room in layout['rooms']}
    events = pd.read_csv(home / 'events.csv.gz', parse_dates=['time'])
    events = events[events.value.isin(['ON', 'OPEN', 'PRESENT'])]
    events['feature'] = events.kind + ' ' + events.room.map(use).fillna('')
    counts = events.groupby([pd.Grouper(key='time', freq=WINDOW), 'feature']).size().unstack()
    minutes = pd.date_range(layout['start'], periods=int(layout['days']) * 1440, freq=WINDOW)
    kinds = [f'{kind} {u}' for kind in ('motion', 'area', 'item', 'door', 'power') for u in USES]
    counts = counts.reindex(index=minutes, columns=kinds).fillna(0.0)
    table = pd.concat([counts, counts.rolling(10, 1).sum().add_suffix(' 10 min'),
                       counts.replace(0, np.nan).ffill(limit=240).notna().add_suffix(' 4 h')],
                      axis=1)
    for use_of in USES:  # minutes since the last motion there
        seen = counts[[c for c in kinds if c.endswith(use_of)]].sum(axis=1) > 0
        last = pd.Series(np.where(seen, np.arange(len(seen)), np.nan), seen.index).ffill()
        table[f'since {use_of}'] = (np.arange(len(seen)) - last).fillna(1440).clip(upper=1440)
    table['hour'] = minutes.hour + minutes.minute / 60
    truth = pd.read_csv(home / 'truth.csv.gz')
    starts = pd.to_datetime(layout['start']) + pd.to_timedelta(truth.start, unit='s')
    label = pd.Series(truth.activity.map(GROUPS).fillna('other').values, starts)
    return table, label[~label.index.duplicated(keep='last')].reindex(minutes, method='ffill')


def main() -> None:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument('--days', default='30')
    parser.add_argument('-o', '--out', type=Path, default=Path('out'))
    args = parser.parse_args()
    homes = []
    for seed, profile in ((1, 'retired'), (2, 'worker'), (3, 'retired')):
        homes.append(args.out / f'learn{seed}')
        subprocess.run(['angen', 'generate', '--days', args.days, '--residents', profile,
                        '--seed', str(seed), '--format', 'csv', '--out', str(homes[-1])],
                       check=True)
    tables = [windows(home) for home in homes]
    x, y = pd.concat([t[0] for t in tables[:2]]), pd.concat([t[1] for t in tables[:2]])
    model = RandomForestClassifier(100, min_samples_leaf=3, class_weight='balanced_subsample',
                                   random_state=0).fit(x, y)
    test_x, test_y = tables[2]
    said = model.predict(test_x)
    least = DummyClassifier().fit(x, y).predict(test_x)
    names = sorted(set(test_y) | set(said))
    print(pd.DataFrame(confusion_matrix(test_y, said, labels=names), names, names).to_string())
    for name, values in (('forest', said), ('majority', least)):
        print(f'macro F1 of the {name}: {f1_score(test_y, values, average="macro"):.2f}')
    shown = ConfusionMatrixDisplay.from_predictions(test_y, said, normalize='true',
                                                    xticks_rotation=60, values_format='.2f')
    shown.figure_.savefig(args.out / 'activity_recognition.png', bbox_inches='tight')


if __name__ == '__main__':
    main()
