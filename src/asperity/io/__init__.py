"""Layer 3: documents, result files, export and provenance; the door between SI arrays and files."""
