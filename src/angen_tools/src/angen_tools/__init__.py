"""The angen command and what it is made of."""
