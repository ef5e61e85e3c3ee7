"""Plants, and other objects that stand or lie about: placement and shapes."""
