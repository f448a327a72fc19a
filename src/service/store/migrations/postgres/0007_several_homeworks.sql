-- A portrait is of a hand-in under one version of the homework's folder. Earlier ones do not say under which: they are drawn again.
DROP TABLE portraits;
CREATE TABLE portraits (
    assignment_digest TEXT NOT NULL,
    sha256            TEXT NOT NULL,
    png               BYTEA,
    PRIMARY KEY (assignment_digest, sha256)
);

-- The homework whose class a teacher's session opens; none: all.
ALTER TABLE teacher_sessions ADD COLUMN assignment TEXT;
