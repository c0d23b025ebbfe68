"""What builds, compares and guards the figures and the repository; not a part of the library."""
