-- The number by which Moodle's files name a student ("Participant 1234"), where the roster has it.
ALTER TABLE students ADD COLUMN moodle BIGINT;

-- Who of the roster an entry of an archive is.
ALTER TABLE batch_entries ADD COLUMN student_id TEXT REFERENCES students (id) ON DELETE SET NULL;
CREATE INDEX batch_entries_of_student ON batch_entries (student_id);

-- A deletion looks these up by the submission.
CREATE INDEX batch_entries_of_submission ON batch_entries (submission_id);
CREATE INDEX regraded_of_submission ON regraded (submission_id);

-- What teachers deleted: how much of what, and nothing of whose it was.
CREATE TABLE deletions (
    id     TEXT PRIMARY KEY,
    at     BIGINT NOT NULL,
    -- 'submission', 'batch' or 'student'.
    what   TEXT NOT NULL,
    -- Numbers as a JSON object.
    counts TEXT NOT NULL
);
