"""Layer 2: contact problems, the operators, laws and solvers behind them, and their results."""
