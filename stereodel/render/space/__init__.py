"""Pictures in space: bodies, GLB files, and PNG with light and shade."""
