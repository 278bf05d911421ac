"""From a problem document to its outcome: the document, what it describes, and the one executor."""
