"""The start of the scripts."""
import signal
import sys
from importlib import import_module


def run_main(module: str) -> None:
    """Runs main() of a module. Ctrl-C while the module is imported ends the process, and prints no
    traceback; so does one before, where the caller has blocked it."""
    if signal.getsignal(signal.SIGINT) != signal.SIG_IGN:  # ignored in the background
        signal.signal(signal.SIGINT, signal.SIG_DFL)
    signal.pthread_sigmask(signal.SIG_UNBLOCK, {signal.SIGINT})
    import_module(module).main()


def run_node(module: str) -> None:
    """run_main() of a node. A failure after rospy has shut down is the end of the node: a signal
    ends the calls that it is in, and closes its topics."""
    try:
        run_main(module)
    except Exception:
        rospy = sys.modules.get('rospy')
        if rospy is None or not rospy.is_shutdown():
            raise
