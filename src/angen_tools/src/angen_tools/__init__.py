"""The angen command and its parts."""
