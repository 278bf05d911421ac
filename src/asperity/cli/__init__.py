"""Layer 8: the command line. It parses options into a problem document, calls the library and
prints."""
