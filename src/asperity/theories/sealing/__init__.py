"""Flow through gaps: single gaps in closed form, media of many gaps, roughness in a film."""
