"""Applications on the simulator: patrols, searches, walk tests, care, maps and the like."""
