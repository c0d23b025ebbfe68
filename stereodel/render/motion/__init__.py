"""Moving pictures: frames drawn in several processes and kept until the film is complete, one module a file format."""
