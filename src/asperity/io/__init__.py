"""Layer 3: documents, result files, export and provenance; SI arrays to files and back."""
