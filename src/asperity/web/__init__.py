"""The web application on this machine: pages over one document, and workers that solve it."""
