"""Tasks in processes, begun, watched and begun again, and files that are written whole or not at all."""
