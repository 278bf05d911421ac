"""Motion on rough interfaces: normal compliance, vibration, stick-slip, sliding blocks."""
