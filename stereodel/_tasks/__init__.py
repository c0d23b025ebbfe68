"""Tasks in processes: begun, watched and begun again. Films, partitions and the builder of figures use them."""
