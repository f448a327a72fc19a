-- Learning platforms that speak LTI 1.3.
CREATE TABLE lti_platforms (
    id             TEXT PRIMARY KEY,
    issuer         TEXT NOT NULL,
    client_id      TEXT NOT NULL,
    name           TEXT NOT NULL,
    auth_url       TEXT NOT NULL,
    token_url      TEXT NOT NULL,
    keys_url       TEXT NOT NULL,
    -- Who a request for a token is addressed to, where that is not the address itself.
    token_audience TEXT,
    is_active      BIGINT NOT NULL,
    created_at     BIGINT NOT NULL,
    UNIQUE (issuer, client_id)
);

-- Where the tool is deployed in a platform; others are foreign until somebody approves them.
CREATE TABLE lti_deployments (
    platform_id   TEXT NOT NULL REFERENCES lti_platforms (id) ON DELETE CASCADE,
    deployment_id TEXT NOT NULL,
    is_approved   BIGINT NOT NULL,
    PRIMARY KEY (platform_id, deployment_id)
);

-- Launches under way; the state is stored as a hash only, and goes when it is used.
CREATE TABLE lti_launches (
    state_hash  TEXT PRIMARY KEY,
    platform_id TEXT NOT NULL REFERENCES lti_platforms (id) ON DELETE CASCADE,
    nonce       TEXT NOT NULL,
    -- What the platform began it with, to begin it again in a window of its own.
    begun_by    TEXT NOT NULL,
    expires_at  BIGINT NOT NULL
);

-- Links of a platform's courses to homeworks.
CREATE TABLE lti_links (
    platform_id TEXT NOT NULL REFERENCES lti_platforms (id) ON DELETE CASCADE,
    link_id     TEXT NOT NULL,
    assignment  TEXT NOT NULL,
    context     TEXT NOT NULL,
    -- Where scores go, and where the list of the course's people is; none where the platform has none.
    line_item   TEXT,
    memberships TEXT,
    PRIMARY KEY (platform_id, link_id)
);

-- A platform's people.
CREATE TABLE lti_people (
    platform_id TEXT NOT NULL REFERENCES lti_platforms (id) ON DELETE CASCADE,
    subject     TEXT NOT NULL,
    student_id  TEXT REFERENCES students (id) ON DELETE CASCADE,
    staff_id    TEXT REFERENCES staff (id) ON DELETE CASCADE,
    PRIMARY KEY (platform_id, subject)
);
CREATE INDEX lti_people_of_student ON lti_people (student_id);

-- Whose score a link takes, and which one it has.
CREATE TABLE lti_scores (
    platform_id   TEXT NOT NULL,
    link_id       TEXT NOT NULL,
    subject       TEXT NOT NULL,
    -- What was sent last.
    submission_id TEXT,
    score         DOUBLE PRECISION,
    sent_at       BIGINT NOT NULL,
    tries         BIGINT NOT NULL,
    next_at       BIGINT NOT NULL,
    problem       TEXT,
    PRIMARY KEY (platform_id, link_id, subject),
    FOREIGN KEY (platform_id, link_id) REFERENCES lti_links (platform_id, link_id) ON DELETE CASCADE,
    FOREIGN KEY (platform_id, subject) REFERENCES lti_people (platform_id, subject) ON DELETE CASCADE
);

-- The keys with which the service signs, the newest last.
CREATE TABLE lti_keys (
    id         TEXT PRIMARY KEY,
    pem        TEXT NOT NULL,
    created_at BIGINT NOT NULL
);
