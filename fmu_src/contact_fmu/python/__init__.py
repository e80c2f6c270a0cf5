"""The packaging for hosts that have Python with this package installed."""
