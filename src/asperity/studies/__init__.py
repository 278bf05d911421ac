"""Layer 7: campaigns over many contacts, unattended and resumable."""
