-- Times are milliseconds since 1970 in UTC, ids are UUIDs in text, truth is 0 or 1: the same values in both databases.

CREATE TABLE settings (
    name  TEXT PRIMARY KEY,
    value TEXT NOT NULL
);

CREATE TABLE assignments (
    id        TEXT PRIMARY KEY,
    -- Seed of the probes of every grading of this assignment.
    seed      BIGINT NOT NULL,
    hints     TEXT NOT NULL,
    opens_at  BIGINT,
    closes_at BIGINT,
    attempts  BIGINT,
    -- 'open': anybody; 'number': whoever came by the course link and gave a student number.
    audience  TEXT NOT NULL
);

CREATE TABLE students (
    id         TEXT PRIMARY KEY,
    number     TEXT NOT NULL UNIQUE,
    name       TEXT NOT NULL,
    on_roster  BIGINT NOT NULL,
    created_at BIGINT NOT NULL
);

-- A browser that handed something in. Its cookie is stored as a hash only.
CREATE TABLE owners (
    id         TEXT PRIMARY KEY,
    token_hash TEXT NOT NULL UNIQUE,
    student_id TEXT REFERENCES students (id),
    created_at BIGINT NOT NULL
);

CREATE TABLE teacher_sessions (
    token_hash TEXT PRIMARY KEY,
    created_at BIGINT NOT NULL,
    expires_at BIGINT NOT NULL
);

CREATE TABLE uploads (
    sha256      TEXT PRIMARY KEY,
    bytes       BYTEA NOT NULL
);

CREATE TABLE batches (
    id          TEXT PRIMARY KEY,
    assignment  TEXT NOT NULL REFERENCES assignments (id),
    title       TEXT NOT NULL,
    refused     TEXT NOT NULL,
    created_at  BIGINT NOT NULL
);

CREATE TABLE submissions (
    id            TEXT PRIMARY KEY,
    assignment    TEXT NOT NULL REFERENCES assignments (id),
    sha256        TEXT NOT NULL REFERENCES uploads (sha256),
    name          TEXT NOT NULL,
    owner_id      TEXT REFERENCES owners (id),
    student_id    TEXT REFERENCES students (id),
    batch_id      TEXT REFERENCES batches (id) ON DELETE CASCADE,
    -- 'page', 'editor' (a draft: not in any history), 'api' or 'batch'.
    via           TEXT NOT NULL,
    seed          BIGINT NOT NULL,
    hints         TEXT NOT NULL,
    received_at   BIGINT NOT NULL,
    -- 'queued', 'graded' or 'failed' (our fault).
    state         TEXT NOT NULL,
    fault         TEXT,
    tries         BIGINT NOT NULL,
    -- Smaller is sooner.
    priority      BIGINT NOT NULL,
    claimed_by    TEXT,
    claimed_until BIGINT NOT NULL
);
CREATE INDEX submissions_waiting ON submissions (priority, received_at) WHERE state <> 'graded';
CREATE INDEX submissions_of_owner ON submissions (owner_id, received_at);
CREATE INDEX submissions_of_student ON submissions (student_id, received_at);
CREATE INDEX submissions_of_batch ON submissions (batch_id);
CREATE INDEX submissions_of_file ON submissions (sha256, assignment);
CREATE INDEX submissions_by_time ON submissions (assignment, received_at);

-- One report per submission, whatever happens: the key is the submission.
CREATE TABLE reports (
    submission_id TEXT PRIMARY KEY REFERENCES submissions (id) ON DELETE CASCADE,
    graded_at     BIGINT NOT NULL,
    verdict       TEXT NOT NULL,
    score         DOUBLE PRECISION NOT NULL,
    max_score     DOUBLE PRECISION NOT NULL,
    mistakes      TEXT NOT NULL,
    report        TEXT NOT NULL,
    ggrade        TEXT NOT NULL,
    reused        BIGINT NOT NULL
);

-- A small picture of what a file draws.
CREATE TABLE portraits (
    assignment TEXT NOT NULL,
    sha256     TEXT NOT NULL,
    png        BYTEA,
    PRIMARY KEY (assignment, sha256)
);

-- Everyone of a batch in the order of the input, whether there was something to grade or not.
CREATE TABLE batch_entries (
    batch_id      TEXT NOT NULL REFERENCES batches (id) ON DELETE CASCADE,
    position      BIGINT NOT NULL,
    student       TEXT NOT NULL,
    path          TEXT,
    submission_id TEXT REFERENCES submissions (id) ON DELETE SET NULL,
    note          TEXT,
    PRIMARY KEY (batch_id, position)
);

-- Grading everything again, beside the reports that stand.
CREATE TABLE regradings (
    id         TEXT PRIMARY KEY,
    assignment TEXT NOT NULL REFERENCES assignments (id),
    seed       BIGINT NOT NULL,
    hints      TEXT NOT NULL,
    created_at BIGINT NOT NULL,
    adopted_at BIGINT
);

CREATE TABLE regraded (
    regrading_id  TEXT NOT NULL REFERENCES regradings (id) ON DELETE CASCADE,
    submission_id TEXT NOT NULL REFERENCES submissions (id) ON DELETE CASCADE,
    state         TEXT NOT NULL,
    verdict       TEXT,
    score         DOUBLE PRECISION,
    mistakes      TEXT,
    report        TEXT,
    claimed_by    TEXT,
    claimed_until BIGINT NOT NULL,
    PRIMARY KEY (regrading_id, submission_id)
);
CREATE INDEX regraded_waiting ON regraded (claimed_until) WHERE state = 'queued';
