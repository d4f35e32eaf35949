"""What goes back into other systems, read with those systems' own rules."""
