-- Tokens by which programs act for somebody who teaches.
CREATE TABLE access_tokens (
    id           TEXT PRIMARY KEY,
    -- Whose it is; with the account it goes.
    staff_id     TEXT NOT NULL REFERENCES staff (id) ON DELETE CASCADE,
    -- What its owner calls it.
    name         TEXT NOT NULL,
    -- 'read', 'submit' or 'all'.
    scope        TEXT NOT NULL,
    -- The homework that it is for; none: all that its owner sees.
    assignment   TEXT,
    -- The token itself is shown once and kept nowhere.
    token_hash   TEXT NOT NULL UNIQUE,
    created_at   BIGINT NOT NULL,
    expires_at   BIGINT NOT NULL,
    -- To the hour; none: never.
    last_used_at BIGINT
);
CREATE INDEX access_tokens_of_staff ON access_tokens (staff_id);
