-- Points that somebody who teaches gave a line of the rubric in place of those of the grading.
CREATE TABLE overrides (
    submission_id TEXT NOT NULL REFERENCES submissions (id) ON DELETE CASCADE,
    -- Id of the line.
    line          TEXT NOT NULL,
    points        DOUBLE PRECISION NOT NULL,
    -- What the grading gave when it was overridden.
    graded        DOUBLE PRECISION NOT NULL,
    -- Read by the student.
    reason        TEXT NOT NULL,
    staff_id      TEXT REFERENCES staff (id),
    at            BIGINT NOT NULL,
    PRIMARY KEY (submission_id, line)
);

-- What somebody who teaches says about a line of a file that was handed in.
CREATE TABLE comments (
    id            TEXT PRIMARY KEY,
    submission_id TEXT NOT NULL REFERENCES submissions (id) ON DELETE CASCADE,
    -- Name of the file, and the line in it, from 1.
    file          TEXT NOT NULL,
    line          BIGINT NOT NULL,
    text          TEXT NOT NULL,
    staff_id      TEXT REFERENCES staff (id),
    at            BIGINT NOT NULL
);
CREATE INDEX comments_of_submission ON comments (submission_id);

-- Students who ask for another look at a line of the rubric: each once in a homework.
CREATE TABLE appeals (
    id            TEXT PRIMARY KEY,
    submission_id TEXT NOT NULL REFERENCES submissions (id) ON DELETE CASCADE,
    assignment    TEXT NOT NULL REFERENCES assignments (id),
    -- Id of the student, or of the browser where nobody said who sits there.
    asker         TEXT NOT NULL,
    -- Id of the line.
    line          TEXT NOT NULL,
    question      TEXT NOT NULL,
    asked_at      BIGINT NOT NULL,
    -- Who is handling it; none with a secret of the whole service.
    handler_id    TEXT REFERENCES staff (id),
    taken_at      BIGINT,
    answer        TEXT,
    answered_at   BIGINT,
    UNIQUE (assignment, asker)
);
CREATE INDEX appeals_of_submission ON appeals (submission_id);
