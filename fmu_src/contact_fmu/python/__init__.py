"""The pythonfmu packaging: FMUs for hosts that have Python with this package installed."""
