"""THE place for new numerical methods: solvers of the contact problem, all behind one protocol."""
