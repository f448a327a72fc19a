-- Whether the role of somebody who teaches is the one that a learning platform vouches for: it goes when the platform takes it away. A role
-- that a person gave stays. Of earlier accounts those of platforms are so whose role nobody has changed since.
ALTER TABLE staff ADD COLUMN is_vouched BIGINT NOT NULL DEFAULT 0;
UPDATE staff SET is_vouched = 1 WHERE is_member = 1 AND role <> 'administrator' AND login LIKE 'lti-%'
    AND NOT EXISTS (SELECT 1 FROM acts a WHERE a.act IN ('person', 'person-added') AND a.detail LIKE staff.login || ' %');
