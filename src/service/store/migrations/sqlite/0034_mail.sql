-- The mail address that the roster says; empty where it says none.
ALTER TABLE students ADD COLUMN email TEXT NOT NULL DEFAULT '';
