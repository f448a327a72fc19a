-- A hand-in is a set of files. Its digest is that of its named files; that of one file is the file's own.
ALTER TABLE submissions ADD COLUMN digest TEXT NOT NULL DEFAULT '';
UPDATE submissions SET digest = sha256;

-- The files of each submission, in the order of the homework. `submissions` keeps the first of them in `sha256`, and their
-- names in `name`.
CREATE TABLE submission_files (
    submission_id TEXT NOT NULL REFERENCES submissions (id) ON DELETE CASCADE,
    position      BIGINT NOT NULL,
    name          TEXT NOT NULL,
    sha256        TEXT NOT NULL REFERENCES uploads (sha256),
    PRIMARY KEY (submission_id, position)
);
INSERT INTO submission_files (submission_id, position, name, sha256) SELECT id, 0, name, sha256 FROM submissions;

CREATE INDEX submission_files_of_file ON submission_files (sha256);
CREATE INDEX submissions_of_digest ON submissions (digest, assignment);
DROP INDEX submissions_of_file;
