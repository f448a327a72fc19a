-- Folders of homeworks that were uploaded, each with what it extends.
CREATE TABLE folders (
    id           TEXT PRIMARY KEY,
    -- Id of the homework, as its assignment.toml has it.
    assignment   TEXT NOT NULL,
    digest       TEXT NOT NULL UNIQUE,
    uploaded_at  BIGINT NOT NULL,
    -- None: by a secret of the whole service, or by a program.
    staff_id     TEXT REFERENCES staff (id),
    -- The reports of its own files, as JSON.
    solution     TEXT NOT NULL,
    handed_out   TEXT NOT NULL,
    -- When it was published; the latest of a homework is served.
    published_at BIGINT
);
CREATE INDEX folders_of_assignment ON folders (assignment, published_at);

CREATE TABLE folder_files (
    folder_id TEXT NOT NULL REFERENCES folders (id) ON DELETE CASCADE,
    name      TEXT NOT NULL,
    bytes     BYTEA NOT NULL,
    PRIMARY KEY (folder_id, name)
);

-- The folder by which everything is graded again; none: the one that is served.
ALTER TABLE regradings ADD COLUMN folder_id TEXT REFERENCES folders (id) ON DELETE CASCADE;
