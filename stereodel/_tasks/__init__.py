"""Tasks in threads and in processes, begun, watched and begun again; files that are written whole or not at all."""
