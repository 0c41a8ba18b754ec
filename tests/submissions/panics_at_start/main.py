"""Never gets as far as its arguments."""

raise RuntimeError("no configuration found")
