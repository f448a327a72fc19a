-- A platform's courses, and to which course here each of them belongs.
CREATE TABLE lti_contexts (
    platform_id TEXT NOT NULL REFERENCES lti_platforms (id) ON DELETE CASCADE,
    context     TEXT NOT NULL,
    title       TEXT NOT NULL,
    -- Id of the course; empty: the one with which the platform is registered; none: nobody has said.
    course      TEXT,
    PRIMARY KEY (platform_id, context)
);
INSERT INTO lti_contexts (platform_id, context, title, course)
    SELECT DISTINCT platform_id, context, '', '' FROM lti_links;
