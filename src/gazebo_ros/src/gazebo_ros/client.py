"""gzclient: rviz with Angen's view."""
import os
import shutil
import sys
from pathlib import Path

from rospkg import RosPack


def run(words: list[str]) -> None:
    """Become rviz; where there is no display, say so and end well."""
    if not os.environ.get('DISPLAY'):
        print('gzclient: there is no display, so no window is opened')
        return
    rviz = shutil.which('rviz')
    if rviz is None:
        sys.exit('gzclient: rviz is not installed; apt install rviz')
    view = Path(RosPack().get_path('angen_sim')) / 'launch' / 'angen.rviz'
    os.execv(rviz, [rviz, '-d', str(view)] + [word for word in words if ':=' in word])
