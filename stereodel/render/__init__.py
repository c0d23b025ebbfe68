"""Pictures: views, scenes and their pages; vector files through matplotlib, pixels through OpenGL."""
