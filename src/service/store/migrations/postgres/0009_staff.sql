-- Who teaches: everybody logs in as themselves.
CREATE TABLE staff (
    id              TEXT PRIMARY KEY,
    -- In small letters.
    login           TEXT NOT NULL UNIQUE,
    name            TEXT NOT NULL,
    -- 'administrator', 'lecturer' or 'assistant'.
    role            TEXT NOT NULL,
    -- None until they have chosen a password.
    password_hash   TEXT,
    -- The link by which they choose one, as a hash only.
    invitation_hash TEXT UNIQUE,
    invited_until   BIGINT,
    is_active       BIGINT NOT NULL,
    created_at      BIGINT NOT NULL
);

-- Whose session it is; none: of who logged in with a secret of the whole service.
ALTER TABLE teacher_sessions ADD COLUMN staff_id TEXT REFERENCES staff (id) ON DELETE CASCADE;

-- What teachers did.
CREATE TABLE acts (
    id         TEXT PRIMARY KEY,
    at         BIGINT NOT NULL,
    -- None: by a secret of the whole service, or by a program.
    staff_id   TEXT REFERENCES staff (id),
    -- 'account', 'password' or 'token'.
    way        TEXT NOT NULL,
    act        TEXT NOT NULL,
    assignment TEXT,
    -- The student whom it was about.
    student_id TEXT REFERENCES students (id) ON DELETE SET NULL,
    detail     TEXT NOT NULL
);
CREATE INDEX acts_by_time ON acts (at);
CREATE INDEX acts_of_student ON acts (student_id);
