-- Who is in a course of a platform: each of its links takes their scores, also of what they handed in without opening the link. Of before it
-- is known of who opened one.
CREATE TABLE lti_members (
    platform_id TEXT NOT NULL,
    context     TEXT NOT NULL,
    subject     TEXT NOT NULL,
    PRIMARY KEY (platform_id, context, subject),
    FOREIGN KEY (platform_id, subject) REFERENCES lti_people (platform_id, subject) ON DELETE CASCADE
);
CREATE INDEX lti_members_of_person ON lti_members (platform_id, subject);
INSERT INTO lti_members (platform_id, context, subject)
    SELECT DISTINCT k.platform_id, l.context, k.subject FROM lti_scores k
    JOIN lti_links l ON l.platform_id = k.platform_id AND l.link_id = k.link_id WHERE l.context <> '';
