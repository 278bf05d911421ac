"""Layer 4: campaigns over many contacts, unattended and resumable."""
