"""Memory and records that the kernels fill; objects that own such memory."""
