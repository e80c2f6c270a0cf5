"""The variable table of each FMU."""
