"""angen automation-test: home automations over simulated days of a home."""
