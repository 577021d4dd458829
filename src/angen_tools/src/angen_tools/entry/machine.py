"""The machine of ./angen run: its display, and the access to its ROS master."""
import os
import re
import subprocess
import sys

OPEN_DISPLAY = '''
import ctypes
x11 = ctypes.CDLL("libX11.so.6")
x11.XOpenDisplay.restype = ctypes.c_void_p
raise SystemExit(0 if x11.XOpenDisplay(None) else 1)'''
DISPLAY_LIMIT = 5.0  # s; a display that is not there may block
LOCAL = re.compile(r'[a-z]+://(localhost|127\.[0-9.]+|\[::1\])([:/]|$)')


def has_display() -> bool:
    """Whether windows can be opened on $DISPLAY."""
    if not os.environ.get('DISPLAY'):
        return False
    try:
        return subprocess.run([sys.executable, '-c', OPEN_DISPLAY], stderr=subprocess.DEVNULL,
                              timeout=DISPLAY_LIMIT, check=False).returncode == 0
    except subprocess.TimeoutExpired:
        return False


def stay_local() -> None:
    """ROS has no authentication: only this machine's programs reach nodes that start from now on,
    unless the environment allows others."""
    if os.environ.get('ROS_HOSTNAME') or os.environ.get('ROS_IP'):
        return
    if LOCAL.match(os.environ.get('ROS_MASTER_URI') or 'http://localhost'):
        os.environ['ROS_HOSTNAME'] = 'localhost'
