-- The courses beside the first one, whose tables these are. Each has tables of its own: another file, or another schema.
CREATE TABLE courses (
    id         TEXT PRIMARY KEY,
    created_at BIGINT NOT NULL
);

-- A homework's place in its course.
-- Whether the course has it, where the command line does not say so.
ALTER TABLE assignments ADD COLUMN is_chosen BIGINT NOT NULL DEFAULT 0;
-- Its place in the order, from 0; none: behind all that have one.
ALTER TABLE assignments ADD COLUMN position BIGINT;
-- What it counts in the course; none: as many points as its rubric has.
ALTER TABLE assignments ADD COLUMN points DOUBLE PRECISION;
-- Whether students see it, and from when on.
ALTER TABLE assignments ADD COLUMN is_hidden BIGINT NOT NULL DEFAULT 0;
ALTER TABLE assignments ADD COLUMN shown_from BIGINT;

-- Whether an account is of somebody who teaches in the first course; others teach in other courses only.
ALTER TABLE staff ADD COLUMN is_member BIGINT NOT NULL DEFAULT 1;
